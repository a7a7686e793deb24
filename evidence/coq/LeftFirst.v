(** The maneuver LRL at [R = 1]: left to the switching curve, right for more than half a turn, left onto the target.

    Both switching points are determined by one parameter [s], the sine of half of what the middle arc lacks to a whole
    turn: they are [m e^(i a)] and [n e^(-i a)], [sin a = s], with [m = 3 s - w], [n = s - w], [w = sqrt (s^2 + 3)]. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst.
Open Scope R_scope.

(** Proves an equation of polynomials in [w], given [sq : w * w = a], by replacing the powers of [w]. *)
Ltac reduce_powers w sq :=
  match type of sq with _ = ?a =>
    replace (w ^ 7) with (w * a * a * a) by (rewrite <- sq; ring);
    replace (w ^ 6) with (a * a * a) by (rewrite <- sq; ring);
    replace (w ^ 5) with (w * a * a) by (rewrite <- sq; ring);
    replace (w ^ 4) with (a * a) by (rewrite <- sq; ring);
    replace (w ^ 3) with (w * a) by (rewrite <- sq; ring);
    replace (w ^ 2) with a by (rewrite <- sq; ring);
    ring
  end.

Definition w_of (s : R) : R := sqrt (s * s + 3).
Definition c_of (s : R) : R := sqrt (1 - s * s).
Definition m_of (s : R) : R := 3 * s - w_of s.

(** The time from the upward direction through [(0, -1)] to the target. *)
Definition turn_to (k s : R) : R := atan (k * c_of s / (1 + k * s)).
Definition arcs (s : R) : R := turn_to (m_of s) s + (2 * PI - 2 * asin s) + turn_to (w_of s - s) s.

(** The squared distance of the first switching point from [(0, -1)]. *)
Definition circle_sq (s : R) : R := 16 * (s * s) - 8 * (s * w_of s) + 4.

Lemma w_sq s : w_of s * w_of s = s * s + 3.
Proof. apply sqrt_sqrt. pose proof (pow2_ge_0 s). lra. Qed.

Lemma w_pos s : 0 < w_of s.
Proof. apply sqrt_lt_R0. pose proof (pow2_ge_0 s). lra. Qed.

Lemma c_sq s : -1 < s < 1 -> c_of s * c_of s = 1 - s * s.
Proof. intros inside. apply sqrt_sqrt. nra. Qed.

Lemma c_pos s : -1 < s < 1 -> 0 < c_of s.
Proof. intros inside. apply sqrt_lt_R0. nra. Qed.

Lemma m_circle s : m_of s * m_of s + 2 * m_of s * s + 1 = circle_sq s.
Proof. unfold m_of, circle_sq. pose proof (w_sq s). nra. Qed.

Lemma is_derive_w s : is_derive w_of s (s / w_of s).
Proof.
  pose proof (pow2_ge_0 s). pose proof (w_pos s). unfold w_of in *. auto_derive; [lra|]. field. lra.
Qed.

Lemma is_derive_c s : -1 < s < 1 -> is_derive c_of s (- s / c_of s).
Proof.
  intros inside. pose proof (c_pos s inside). unfold c_of in *. auto_derive; [nra|].
  replace (1 + - (s * s)) with (1 - s * s) by ring. field. lra.
Qed.

Lemma is_derive_turn (k : R -> R) s k' : -1 < s < 1 -> 0 < 1 + k s * s -> is_derive k s k' ->
  is_derive (fun v => turn_to (k v) v) s
    ((k' * (1 - s * s) - k s * s - k s * k s) / (c_of s * (1 + 2 * k s * s + k s * k s))).
Proof.
  intros inside pos dk. pose proof (c_pos s inside) as cpos. pose proof (c_sq s inside) as cc.
  pose proof (is_derive_c s inside) as dc.
  assert (dn : is_derive (fun v => k v * c_of v) s (k' * c_of s + k s * (- s / c_of s))).
  { apply (is_derive_mult k c_of s k' (- s / c_of s)); [exact dk|exact dc|intros; apply Rmult_comm]. }
  assert (dm : is_derive (fun v => 1 + k v * v) s (k' * s + k s)).
  { replace (k' * s + k s) with (0 + (k' * s + k s * 1)) by ring.
    apply (is_derive_plus (fun _ => 1) (fun v => k v * v)); [apply @is_derive_const|].
    apply (is_derive_mult k (fun v => v) s k' 1); [exact dk|apply @is_derive_id|intros; apply Rmult_comm]. }
  pose proof (is_derive_div _ _ _ _ _ dn dm (Rgt_not_eq _ _ pos)) as dq. simpl in dq.
  pose proof (is_derive_comp atan _ _ _ _ (is_derive_atan _) dq) as da. simpl in da.
  match type of da with is_derive _ _ ?v => match goal with |- is_derive _ _ ?w =>
    replace w with v; [exact da|] end end.
  unfold scal; simpl; unfold mult; simpl.
  set (K := k s) in *. set (c := c_of s) in *.
  assert (sq : K * c * (K * c) + (1 + K * s) * (1 + K * s) = 1 + 2 * K * s + K * K)
    by (replace (K * c * (K * c)) with (K * K * (c * c)) by ring; rewrite cc; ring).
  assert (big : 0 < 1 + 2 * K * s + K * K) by (rewrite <- sq; nra).
  assert (one : 1 + K * c / (1 + K * s) * (K * c / (1 + K * s))
      = (1 + 2 * K * s + K * K) / ((1 + K * s) * (1 + K * s))) by (rewrite <- sq; field; lra).
  rewrite one.
  replace ((k' * c + K * (- s / c)) * (1 + K * s) - K * c * (k' * s + K))
    with ((k' * (c * c) - K * s * (1 + K * s) - K * K * (c * c)) / c) by (field; lra).
  rewrite cc. field. repeat split; lra.
Qed.

Definition circle_rate (s : R) : R := 32 * s - 8 * (w_of s + s * (s / w_of s)).

Lemma is_derive_circle_sq s : is_derive circle_sq s (circle_rate s).
Proof.
  pose proof (pow2_ge_0 s). pose proof (w_pos s). unfold circle_sq, circle_rate, w_of in *.
  auto_derive; [lra|]. field. lra.
Qed.

(** Parameters of maneuvers: for [s = 1] the first switching point is the target; where [8 s^2 = 3] it is the centre, and
    below that it is in the lower half plane. *)
Definition proper (s : R) : Prop := 0 < s /\ 1 / 5 <= s * s < 1.

Lemma proper_inside s : proper s -> -1 < s < 1.
Proof. intros [pos [_ below]]. nra. Qed.

Lemma m_nonneg s : 0 < s -> 3 / 8 <= s * s -> 0 <= m_of s.
Proof. intros pos above. unfold m_of. pose proof (w_sq s). pose proof (w_pos s). nra. Qed.

Lemma w_over_2s s : proper s -> 0 < w_of s - 2 * s.
Proof. intros [pos [_ below]]. pose proof (w_sq s). pose proof (w_pos s). nra. Qed.

(** The first switching point is above the level of [(0, -1)]. *)
Lemma m_above s : proper s -> 0 < 1 + m_of s * s.
Proof.
  intros [pos [above below]]. unfold m_of. pose proof (w_sq s) as ww. pose proof (w_pos s) as wp.
  assert (s * w_of s < 1 + 3 * (s * s)); [|lra].
  assert ((s * w_of s) * (s * w_of s) = s * s * (s * s + 3)) by (rewrite <- ww; ring).
  apply Rnot_le_lt. intros le.
  assert ((1 + 3 * (s * s)) * (1 + 3 * (s * s)) <= s * w_of s * (s * w_of s)) by (apply Rmult_le_compat; nra). nra.
Qed.

Lemma circle_pos s : proper s -> 0 < circle_sq s.
Proof.
  intros ps. rewrite <- m_circle. pose proof (m_above s ps). destruct ps as [pos [above below]].
  pose proof (pow2_ge_0 (m_of s)). assert (0 < 1 - s * s) by lra.
  assert (0 <= m_of s * m_of s * (1 - s * s)) by (apply Rmult_le_pos; lra). nra.
Qed.

(** The switching condition in terms of the arcs: the arcs together shorten with the distance as they should. *)
Lemma is_derive_arcs s : proper s ->
  is_derive arcs s (- (m_of s + s) / (2 * c_of s * circle_sq s) * circle_rate s).
Proof.
  intros ps. pose proof (proper_inside s ps) as inside. pose proof (m_above s ps) as mpos.
  pose proof (circle_pos s ps) as big. pose proof (w_over_2s s ps) as wpos. destruct ps as [spos bounds].
  pose proof (is_derive_w s) as dw. pose proof (w_pos s) as wp. pose proof (w_sq s) as ww.
  pose proof (c_pos s inside) as cp. pose proof (c_sq s inside) as cc. pose proof (m_circle s) as mc.
  assert (dm : is_derive m_of s (3 - s / w_of s)).
  { unfold m_of. apply (is_derive_minus (fun v => 3 * v) w_of s 3 (s / w_of s)); [|exact dw].
    auto_derive; [exact I|ring]. }
  assert (dn : is_derive (fun v => w_of v - v) s (s / w_of s - 1)).
  { apply (is_derive_minus w_of (fun v => v) s (s / w_of s) 1); [exact dw|apply @is_derive_id]. }
  pose proof (is_derive_turn m_of s _ inside mpos dm) as d1.
  pose proof (is_derive_turn (fun v => w_of v - v) s _ inside ltac:(nra) dn) as d3. simpl in d3.
  assert (d2 : is_derive (fun v => 2 * PI - 2 * asin v) s (- 2 / c_of s)).
  { replace (- 2 / c_of s) with (0 - 2 * / sqrt (1 - s * s)) by (unfold c_of in *; field; lra).
    apply (is_derive_minus (fun _ => 2 * PI) (fun v => 2 * asin v)); [apply @is_derive_const|].
    apply (is_derive_scal asin), is_derive_asin, inside. }
  pose proof (is_derive_plus _ _ _ _ _ (is_derive_plus _ _ _ _ _ d1 d2) d3) as da. simpl in da.
  match type of da with is_derive _ _ ?v => match goal with |- is_derive _ _ ?g =>
    replace g with v; [exact da|] end end.
  unfold plus; simpl. unfold circle_rate. rewrite <- mc.
  assert (four : 1 + 2 * (w_of s - s) * s + (w_of s - s) * (w_of s - s) = 4) by nra.
  rewrite four. rewrite <- mc in big. unfold m_of in *. set (w := w_of s) in *.
  set (c := c_of s) in *. clearbody w c.
  field_simplify_eq; [|repeat split; nra].
  reduce_powers w ww.
Qed.

(** ** The parameter of a state *)

(** The squared distance from [(0, -1)]. *)
Definition outer_sq (x y : R) : R := x * x + (y + 1) * (y + 1).

Definition discriminant (P : R) : R := (P / 2 + 1) * (P / 2 + 1) - 3 / 16 * ((P - 4) * (P - 4)).
Definition s_of (P : R) : R := sqrt ((P / 2 + 1 + sqrt (discriminant P)) / 6).

(** The circles about [(0, -1)] on which LRL begins. *)
Definition reachable (P : R) : Prop := 0 < P < 4 /\ 0 < discriminant P.

Lemma reachable_above P : 1 <= P < 4 -> reachable P.
Proof. intros bounds. unfold reachable, discriminant. split; [lra|nra]. Qed.

Section OnCircle.
  Variable P : R.
  Hypothesis on : reachable P.

  Lemma s_of_sq : s_of P * s_of P = (P / 2 + 1 + sqrt (discriminant P)) / 6.
  Proof. destruct on as [bounds _]. apply sqrt_sqrt. pose proof (sqrt_pos (discriminant P)). lra. Qed.

  Lemma s_of_reachable : proper (s_of P).
  Proof.
    destruct on as [bounds dpos]. pose proof s_of_sq as ss.
    pose proof (sqrt_lt_R0 _ dpos) as rpos. pose proof (sqrt_sqrt (discriminant P) ltac:(lra)) as rr.
    split; [|split].
    - apply sqrt_lt_R0. lra.
    - rewrite ss. unfold discriminant in dpos. assert (1 / 2 < P) by nra. lra.
    - rewrite ss. set (r := sqrt (discriminant P)) in *. unfold discriminant in rr.
      assert (r < 6 - (P / 2 + 1)); [|lra].
      apply Rnot_le_lt. intros high. assert ((6 - (P / 2 + 1)) * (6 - (P / 2 + 1)) <= r * r) by nra.
      pose proof (pow2_ge_0 (P - 4)). nra.
  Qed.

  (** The parameter belongs to the circle about [(0, -1)] on which the state is. *)
  Lemma circle_of_reachable : circle_sq (s_of P) = P.
  Proof.
    pose proof s_of_reachable as [spos sb]. pose proof s_of_sq as ss. destruct on as [bounds dpos].
    pose proof (sqrt_lt_R0 _ dpos) as rpos. pose proof (sqrt_sqrt (discriminant P) ltac:(lra)) as rr.
    set (r := sqrt (discriminant P)) in *. unfold discriminant in rr.
    pose proof (w_sq (s_of P)) as ww. pose proof (w_pos (s_of P)) as wp. unfold circle_sq.
    set (s := s_of P) in *. set (w := w_of s) in *.
    assert (same : s * w = 2 * (s * s) - (P - 4) / 8); [|lra].
    assert (pos1 : 0 <= s * w) by nra. assert (pos2 : 0 <= 2 * (s * s) - (P - 4) / 8) by lra.
    apply Rsqr_inj; [exact pos1|exact pos2|]. unfold Rsqr.
    replace (s * w * (s * w)) with ((s * s) * (w * w)) by ring. rewrite ww, ss.
    assert (r * r = (P / 2 + 1) * (P / 2 + 1) - 3 / 16 * ((P - 4) * (P - 4))) by exact rr. nra.
  Qed.
End OnCircle.

Lemma s_of_proper P : 1 <= P < 4 -> proper (s_of P).
Proof. intros bounds. apply s_of_reachable, reachable_above, bounds. Qed.

Lemma circle_of_s P : 1 <= P < 4 -> circle_sq (s_of P) = P.
Proof. intros bounds. apply circle_of_reachable, reachable_above, bounds. Qed.

Lemma discriminant_pos P : 1 <= P < 4 -> 0 < discriminant P.
Proof. intros bounds. apply reachable_above, bounds. Qed.

Lemma s_of_above P : 1 <= P < 4 -> 3 / 8 <= s_of P * s_of P.
Proof.
  intros bounds. rewrite (s_of_sq P (reachable_above P bounds)). pose proof (discriminant_pos P bounds) as dpos.
  pose proof (sqrt_lt_R0 _ dpos) as rpos. pose proof (sqrt_sqrt (discriminant P) ltac:(lra)) as rr.
  set (r := sqrt (discriminant P)) in *. unfold discriminant in rr.
  assert (9 / 4 - (P / 2 + 1) <= r); [|lra].
  apply Rnot_lt_le. intros low. assert (r * r < (9 / 4 - (P / 2 + 1)) * (9 / 4 - (P / 2 + 1))) by nra. nra.
Qed.

Lemma m_of_above P : 1 <= P < 4 -> 0 <= m_of (s_of P).
Proof. intros bounds. apply m_nonneg; [apply s_of_proper, bounds|apply s_of_above, bounds]. Qed.

Lemma rd_s_of (f : R -> R) t f' : reachable (f t) -> right_derive f t f' ->
  exists s', right_derive (fun v => s_of (f v)) t s'.
Proof.
  intros [bounds dpos] rf.
  pose proof (sqrt_lt_R0 _ dpos) as rpos.
  pose proof (rd_plus _ _ _ _ _ (rd_scal (/ 2) _ _ _ rf) (rd_const 1 t)) as rh. simpl in rh.
  pose proof (rd_minus _ _ _ _ _ (rd_square _ _ _ rh)
    (rd_scal (3 / 16) _ _ _ (rd_square _ _ _ (rd_minus _ _ _ _ _ rf (rd_const 4 t))))) as rD. simpl in rD.
  apply (rd_ext _ (fun v => discriminant (f v))) in rD; [|intros; unfold discriminant; field].
  pose proof (rd_sqrt (fun v => discriminant (f v)) t _ dpos rD) as rr. simpl in rr.
  pose proof (rd_scal (/ 6) _ _ _ (rd_plus _ _ _ _ _ rh rr)) as rs. simpl in rs.
  apply (rd_ext _ (fun v => (f v / 2 + 1 + sqrt (discriminant (f v))) / 6)) in rs; [|intros; field].
  eexists. apply (rd_sqrt (fun v => (f v / 2 + 1 + sqrt (discriminant (f v))) / 6)); [lra|exact rs].
Qed.

Lemma reachable_near (f : R -> R) t f' : reachable (f t) -> right_derive f t f' ->
  exists delta, 0 < delta /\ forall v, t < v < t + delta -> reachable (f v).
Proof.
  intros [bounds dpos] rf. pose proof (rd_right_continuous _ _ _ rf) as lf.
  assert (ld : filterlim (fun v => discriminant (f v)) (at_right t) (locally (discriminant (f t)))).
  { unfold discriminant. pose proof (fl_plus _ _ _ _ (fl_mult _ _ _ _ lf (fl_const (/ 2))) (fl_const 1)) as lh.
    pose proof (fl_minus _ _ _ _ lf (fl_const 4)) as lm.
    apply fl_minus; [apply fl_mult; exact lh|apply fl_scal, fl_mult; exact lm]. }
  destruct (filter_and _ _ (fl_above _ _ 0 (proj1 bounds) lf)
    (filter_and _ _ (fl_below _ _ 4 (proj2 bounds) lf) (fl_above _ _ 0 dpos ld))) as [[d dpos'] H].
  exists d. split; [exact dpos'|]. intros v near.
  destruct (H v) as (h1 & h2 & h3); [change (Rabs (v - t) < d); apply Rabs_lt_between; lra|lra|].
  split; [split|]; assumption.
Qed.

(** The arcs of LRL shorten, as the circle about [(0, -1)] grows, at this rate. *)
Lemma rd_arcs (f : R -> R) t f' : reachable (f t) -> right_derive f t f' ->
  right_derive (fun v => arcs (s_of (f v))) t
    (- (m_of (s_of (f t)) + s_of (f t)) / (2 * c_of (s_of (f t)) * f t) * f').
Proof.
  intros bounds rf.
  pose proof (s_of_reachable _ bounds) as ps. pose proof (circle_of_reachable _ bounds) as same.
  destruct (rd_s_of f t f' bounds rf) as [s' rs].
  pose proof (rd_comp circle_sq (fun v => s_of (f v)) t _ _ (is_derive_circle_sq _) rs) as rc. simpl in rc.
  destruct (reachable_near f t f' bounds rf) as [near [npos inside]].
  assert (rate_of : circle_rate (s_of (f t)) * s' = f').
  { apply (rd_unique f t); [|exact rf].
    intros eps pos. destruct (rc eps pos) as [e [epos H]].
    exists (Rmin e near). split; [apply Rmin_pos; assumption|]. intros v close.
    pose proof (Rmin_l e near). pose proof (Rmin_r e near).
    specialize (H v ltac:(lra)). rewrite (circle_of_reachable (f v) (inside v ltac:(lra))), same in H. exact H. }
  pose proof (rd_comp arcs (fun v => s_of (f v)) t _ _ (is_derive_arcs _ ps) rs) as ra. simpl in ra.
  rewrite same, Rmult_assoc, rate_of in ra. exact ra.
Qed.

(** ** The time of LRL *)

(** The clockwise angle of the state about [(0, -1)] from the upward direction. *)
Definition outer_angle (x y : R) : R := angle_of (y + 1) x.

Definition time_lrl (x y : R) : R := arcs (s_of (outer_sq x y)) - outer_angle x y.

(** The abscissa of the switching curve on the circle about [(0, -1)] through the state. *)
Definition curve_x (P : R) : R := m_of (s_of P) * c_of (s_of P).
Definition curve_y (P : R) : R := m_of (s_of P) * s_of P.

(** The sign that decides whether LRL is optimal to first order. *)
Definition lrl_margin (x y : R) : R :=
  let s := s_of (outer_sq x y) in c_of s * (x * x + y * y + y) - (m_of s + s) * x.

Lemma outer_sq_above x y : 0 <= y -> 1 <= outer_sq x y.
Proof. intros up. unfold outer_sq. nra. Qed.

Lemma rd_outer_sq x y t u : moves x y t u ->
  right_derive (fun v => outer_sq (x v) (y v)) t (2 * (1 - u) * x t).
Proof.
  intros [_ [rx ry]]. replace (2 * (1 - u) * x t)
    with (2 * x t * (1 + u * y t) + 2 * (y t + 1) * (- (u * x t) + 0)) by ring.
  apply (rd_plus (fun v => x v * x v) (fun v => (y v + 1) * (y v + 1))); [exact (rd_square _ _ _ rx)|].
  apply (rd_square (fun v => y v + 1)), rd_plus; [exact ry|apply rd_const].
Qed.

Lemma outer_length x y : (y + 1) * (y + 1) + x * x = outer_sq x y.
Proof. unfold outer_sq. ring. Qed.

Lemma outer_angle_above x y : 0 < y + 1 -> outer_angle x y = atan (x / (y + 1)).
Proof.
  intros pos. unfold outer_angle. destruct (cos_sin_angle_of (y + 1) x (off_cut_intro _ _ (or_introl pos))) as [ec es].
  pose proof (off_cut_length _ _ (off_cut_intro _ x (or_introl pos))) as rpos. pose proof (length_sq (y + 1) x) as rr.
  pose proof (angle_of_bounds (y + 1) x). pose proof (atan_bound (x / (y + 1))).
  set (r := sqrt ((y + 1) * (y + 1) + x * x)) in *.
  assert (root : sqrt (1 + x / (y + 1) * (x / (y + 1))) = r / (y + 1)).
  { apply sqrt_lem_1; [|left; apply Rdiv_lt_0_compat; lra|].
    - pose proof (pow2_ge_0 (x / (y + 1))). lra.
    - replace (r / (y + 1) * (r / (y + 1))) with (r * r / ((y + 1) * (y + 1))) by (field; lra). rewrite rr. field. lra. }
  apply same_angle; [apply Rabs_lt_between; lra| |]; apply Rmult_eq_reg_l with r; try lra.
  - rewrite ec, cos_atan. unfold Rsqr. rewrite root. field. lra.
  - rewrite es, sin_atan. unfold Rsqr. rewrite root. field. lra.
Qed.

Lemma rd_outer_angle x y t u : moves x y t u -> off_cut (y t + 1) (x t) ->
  right_derive (fun v => outer_angle (x v) (y v)) t
    (1 - (1 - u) * (x t * x t + y t * y t + y t) / outer_sq (x t) (y t)).
Proof.
  intros [_ [rx ry]] off.
  pose proof (rd_plus _ _ _ _ _ ry (rd_const 1 t)) as ry1. simpl in ry1.
  pose proof (rd_angle_of _ _ t _ _ off ry1 rx) as ra. simpl in ra. unfold outer_angle.
  match type of ra with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
    replace g with v; [exact ra|] end end.
  pose proof (off_cut_length _ _ off) as rpos. pose proof (length_sq (y t + 1) (x t)) as rr. rewrite outer_length in *.
  assert (0 < outer_sq (x t) (y t)) by nra.
  apply Rmult_eq_reg_r with (outer_sq (x t) (y t)); [|lra]. field_simplify; [|lra|lra]. unfold outer_sq. ring.
Qed.

Lemma rd_time_lrl x y t u : moves x y t u -> off_cut (y t + 1) (x t) -> reachable (outer_sq (x t) (y t)) ->
  right_derive (fun v => time_lrl (x v) (y v)) t
    (- 1 + (1 - u) * lrl_margin (x t) (y t) / (c_of (s_of (outer_sq (x t) (y t))) * outer_sq (x t) (y t))).
Proof.
  intros mv off on.
  pose proof (rd_arcs (fun v => outer_sq (x v) (y v)) t _ on (rd_outer_sq _ _ _ _ mv)) as ra. simpl in ra.
  pose proof (rd_outer_angle _ _ _ _ mv off) as rb.
  pose proof (rd_minus _ _ _ _ _ ra rb) as rt. simpl in rt. unfold time_lrl.
  match type of rt with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
    replace g with v; [exact rt|] end end.
  unfold lrl_margin. pose proof (c_pos _ (proper_inside _ (s_of_reachable _ on))). destruct on as [bounds _].
  field. split; lra.
Qed.

(** Along the circle about [(0, -1)] a point further right is lower. *)
Lemma lower_to_the_right x y x' y' :
  0 <= x -> x <= x' -> 0 < y + 1 -> 0 < y' + 1 -> outer_sq x y = outer_sq x' y' -> y' <= y.
Proof. unfold outer_sq. intros. apply Rnot_lt_le. intros higher. nra. Qed.

(** ** Points of the switching curve *)

Section Curve.
  Variable s : R.
  Hypothesis ps : proper s.
  Let m := m_of s.
  Let c := c_of s.
  Let w := w_of s.
  Let r := range (m * c) (m * s).

  Lemma curve_facts : 0 < s /\ s * s < 1 /\ 0 < c /\ c * c = 1 - s * s /\ w * w = s * s + 3 /\ m = 3 * s - w
    /\ 0 < w - 2 * s /\ 0 < 1 + m * s.
  Proof.
    pose proof (proper_inside _ ps) as si. repeat split; try apply ps.
    - apply c_pos, si.
    - apply c_sq, si.
    - apply w_sq.
    - apply w_over_2s, ps.
    - apply m_above, ps.
  Qed.

  Lemma curve_range : range_sq (m * c) (m * s) = 4 * (1 + s * s - s * w).
  Proof.
    destruct curve_facts as (spos & below & cpos & cc & ww & mw & wpos & mP).
    unfold range_sq. replace (m * c * (m * c)) with (m * m * (c * c)) by ring. rewrite cc, mw.
    transitivity (9 * (s * s) - 6 * (s * w) + w * w - 2 * s * (3 * s - w) + 1); [ring|rewrite ww; ring].
  Qed.

  (** The switching condition, seen from the target. *)
  Lemma curve_from_target : 3 * r * c = (w - 2 * s) * sqrt (16 - range_sq (m * c) (m * s)).
  Proof.
    destruct curve_facts as (spos & below & cpos & cc & ww & mw & wpos & mP). pose proof curve_range as q.
    pose proof (range_range (m * c) (m * s)) as rr. pose proof (range_sq_nonneg (m * c) (m * s)) as qpos.
    assert (rpos : 0 <= r) by apply sqrt_pos. fold r in rr. rewrite q in *.
    assert (rest : 0 <= 16 - 4 * (1 + s * s - s * w)) by nra.
    apply Rsqr_inj.
    - repeat apply Rmult_le_pos; lra.
    - apply Rmult_le_pos; [lra|apply sqrt_pos].
    - unfold Rsqr. set (v := sqrt (16 - 4 * (1 + s * s - s * w))).
      assert (vv : v * v = 16 - 4 * (1 + s * s - s * w)) by (apply sqrt_sqrt, rest).
      replace (3 * r * c * (3 * r * c)) with (9 * (r * r) * (c * c)) by ring.
      replace ((w - 2 * s) * v * ((w - 2 * s) * v)) with ((w - 2 * s) * (w - 2 * s) * (v * v)) by ring.
      rewrite rr, cc, vv. replace ((w - 2 * s) * (w - 2 * s)) with (w * w - 4 * (s * w) + 4 * (s * s)) by ring.
      rewrite ww. transitivity (36 * (1 - s * s) * (1 + s * s - s * w)); [ring|].
      transitivity (4 * ((5 * (s * s) + 3) * (3 - s * s) + (5 * (s * s) + 3) * (s * w)
        - 4 * (s * w) * (3 - s * s) - 4 * (s * s) * (w * w))); [rewrite ww; ring|ring].
  Qed.

  (** The last arc is twice the angle by which the middle one ends below the horizontal; and the direction from the target
      to the switching point. *)
  Lemma curve_angles : let d := asin (r / 4) in
    r < 4 /\ 0 <= d <= PI / 2 /\ turn_to (w - s) s = 2 * d
    /\ r * cos (d + 2 * asin s - PI) = m * c /\ r * sin (d + 2 * asin s - PI) = m * s - 1.
  Proof.
    destruct curve_facts as (spos & below & cpos & cc & ww & mw & wpos & mP). pose proof curve_range as q.
    pose proof curve_from_target as fromT. intros d. pose proof (proper_inside s ps) as si.
    pose proof (range_range (m * c) (m * s)) as rr. assert (rpos : 0 <= r) by apply sqrt_pos. fold r in rr.
    set (v := sqrt (16 - range_sq (m * c) (m * s))) in *.
    assert (near : range_sq (m * c) (m * s) < 16) by (rewrite q; nra).
    assert (vv : v * v = 16 - range_sq (m * c) (m * s)) by (apply sqrt_sqrt; lra).
    assert (vpos : 0 < v) by (apply sqrt_lt_R0; lra).
    assert (r4 : r < 4) by nra.
    assert (sd : sin d = r / 4) by (apply sin_asin; lra).
    assert (cd : cos d = v / 4).
    { unfold d. rewrite cos_asin by lra. unfold Rsqr. apply sqrt_lem_1; [nra|lra|]. nra. }
    assert (db : 0 <= d <= PI / 2).
    { pose proof (asin_bound (r / 4)) as bound. fold d in bound. split; [|lra]. apply Rnot_lt_le. intros neg.
      assert (sin d < 0) by (apply sin_lt_0_var; pose proof PI_RGT_0; lra). lra. }
    set (a := asin s).
    assert (sa : sin a = s) by (apply sin_asin; lra).
    assert (ca : cos a = c) by (unfold a; rewrite cos_asin by lra; reflexivity).
    assert (key : (w - 2 * s) * (r * v) = 3 * range_sq (m * c) (m * s) * c) by (rewrite <- rr; nra).
    split; [exact r4|]. split; [exact db|]. split; [|split].
    - unfold turn_to. fold c. set (k := w - s). set (g := atan (k * c / (1 + k * s))).
      assert (kpos : 0 < k) by (unfold k; lra).
      assert (gb : 0 <= g <= PI).
      { pose proof (atan_bound (k * c / (1 + k * s))) as bound. fold g in bound. split; [|lra].
        unfold g. rewrite <- atan_0. left. apply atan_increasing. apply Rdiv_lt_0_compat; nra. }
      assert (cg : cos g = (1 + k * s) / 2).
      { unfold g. rewrite cos_atan. unfold Rsqr.
        assert (four : k * c * (k * c) + (1 + k * s) * (1 + k * s) = 4).
        { replace (k * c * (k * c)) with (k * k * (c * c)) by ring. rewrite cc. unfold k.
          transitivity (w * w - s * s + 1); [ring|rewrite ww; ring]. }
        replace (1 + k * c / (1 + k * s) * (k * c / (1 + k * s))) with (2 / (1 + k * s) * (2 / (1 + k * s)))
          by (apply Rmult_eq_reg_r with ((1 + k * s) * (1 + k * s)); [field_simplify; [|nra|nra]; nra|nra]).
        rewrite sqrt_square by (left; apply Rdiv_lt_0_compat; nra). field. nra. }
      rewrite <- (acos_cos g gb), <- (acos_cos (2 * d)) by lra. f_equal.
      rewrite cg, cos_2a_sin, sd. unfold k. apply Rmult_eq_reg_r with 16; [|lra]. field_simplify.
      replace (r ^ 2) with (range_sq (m * c) (m * s)) by (rewrite <- rr; ring). rewrite q. field_simplify. nra.
    - rewrite cos_minus, cos_PI, sin_PI, cos_plus, cos_2a_sin, sin_2a, sa, ca, sd, cd.
      apply Rmult_eq_reg_l with (w - 2 * s); [|lra].
      transitivity (- ((w - 2 * s) * (r * v)) * (1 - 2 * (s * s)) / 4 + (w - 2 * s) * (r * r) * (s * c) / 2); [field|].
      rewrite key, rr, q, mw.
      transitivity (c * (- 3 * (1 + s * s - s * w) * (1 - 2 * (s * s)) + 2 * (w - 2 * s) * (1 + s * s - s * w) * s));
        [field|].
      replace ((w - 2 * s) * ((3 * s - w) * c)) with (c * ((w - 2 * s) * (3 * s - w))) by ring. f_equal.
      transitivity (5 * (s * w) - 3 - s * s + 2 * (s * s) * (s * s) - 2 * (s * s) * (w * w)
        + 0 * w); [ring|rewrite ww]. ring_simplify. replace (w ^ 2) with (s * s + 3) by (rewrite <- ww; ring). ring.
    - rewrite sin_minus, cos_PI, sin_PI, sin_plus, cos_2a_sin, sin_2a, sa, ca, sd, cd.
      apply Rmult_eq_reg_l with (w - 2 * s); [|lra].
      transitivity (- ((w - 2 * s) * (r * r)) * (1 - 2 * (s * s)) / 4 - (w - 2 * s) * (r * v) * (s * c) / 2); [field|].
      rewrite key, rr, q, mw.
      transitivity (- (1 + s * s - s * w) * ((w - 2 * s) * (1 - 2 * (s * s)) + 6 * s * (c * c))); [field|].
      rewrite cc. ring_simplify. replace (w ^ 2) with (s * s + 3) by (rewrite <- ww; ring). ring.
  Qed.
End Curve.

Section Switching.
  Variables x y : R.
  Hypothesis up : 0 <= y.
  Hypothesis inside : outer_sq x y < 4.
  Let P := outer_sq x y.
  Let s := s_of P.
  Let m := m_of s.
  Let c := c_of s.
  Let w := w_of s.

  Lemma P_bounds : 1 <= P < 4.
  Proof. split; [apply outer_sq_above, up|exact inside]. Qed.

  Lemma s_proper : proper s.
  Proof. apply s_of_proper, P_bounds. Qed.

  Lemma facts : 0 < s /\ 0 <= m /\ 0 < c /\ c * c = 1 - s * s /\ w * w = s * s + 3 /\ m = 3 * s - w
    /\ 0 < w - 2 * s /\ m * m + 2 * m * s + 1 = P.
  Proof.
    pose proof s_proper as ps. pose proof (proper_inside _ ps) as si.
    repeat split.
    - apply ps.
    - apply m_of_above, P_bounds.
    - apply c_pos, si.
    - apply c_sq, si.
    - apply w_sq.
    - apply w_over_2s, ps.
    - unfold m. rewrite m_circle. apply circle_of_s, P_bounds.
  Qed.

  (** The switching point is on the circle of the state. *)
  Lemma curve_on_circle : m * c * (m * c) + (m * s + 1) * (m * s + 1) = P.
  Proof.
    destruct facts as (spos & mpos & cpos & cc & ww & mw & wpos & mP).
    replace (m * c * (m * c)) with (m * m * (c * c)) by ring. rewrite cc. rewrite <- mP. ring.
  Qed.

  Lemma lrl_margin_nonneg : x <= curve_x P -> 0 <= lrl_margin x y.
  Proof.
    destruct facts as (spos & mpos & cpos & cc & ww & mw & wpos & mP). pose proof curve_on_circle as on.
    unfold curve_x, lrl_margin. fold P s m c. intros before.
    destruct (Rle_dec x 0) as [left|right].
    - assert (0 <= c * (x * x + y * y + y)) by (apply Rmult_le_pos; nra).
      assert (0 <= (m + s) * - x) by (apply Rmult_le_pos; lra). lra.
    - assert (high : m * s <= y).
      { apply (lower_to_the_right x y (m * c) (m * s)); try lra; [nra|]. unfold outer_sq at 2. rewrite on. reflexivity. }
      assert (circle : x * x + (y + 1) * (y + 1) = P) by reflexivity.
      replace (x * x + y * y + y) with (P - (y + 1)) by lra.
      set (dx := m * c - x). set (sum := m * s + 1 + (y + 1)).
      assert (sumpos : 0 < sum) by (unfold sum; nra).
      assert (chord : dx * (m * c + x) = ((y + 1) - (m * s + 1)) * sum) by (unfold dx, sum; nra).
      assert (at_curve : c * (P - (m * s + 1)) = (m + s) * (m * c)) by (rewrite <- mP; ring).
      assert (steep1 : c * (m * c) <= (m + s) * (m * s + 1)).
      { replace (c * (m * c)) with (m * (c * c)) by ring. rewrite cc. nra. }
      assert (steep : c * (m * c + x) <= (m + s) * sum) by (unfold sum; nra).
      assert (gain : 0 <= ((m + s) * dx - c * ((y + 1) - (m * s + 1))) * sum).
      { replace (((m + s) * dx - c * ((y + 1) - (m * s + 1))) * sum)
          with (dx * ((m + s) * sum) - c * (((y + 1) - (m * s + 1)) * sum)) by ring.
        rewrite <- chord. replace (dx * ((m + s) * sum) - c * (dx * (m * c + x)))
          with (dx * ((m + s) * sum - c * (m * c + x))) by ring.
        apply Rmult_le_pos; unfold dx; lra. }
      assert (0 <= (m + s) * dx - c * ((y + 1) - (m * s + 1))) by nra.
      unfold dx in *. nra.
  Qed.

  (** Right of the switching curve RL cannot be improved to first order. *)
  Lemma rl_margin_right : curve_x P <= x -> 0 <= rl_margin x y.
  Proof.
    destruct facts as (spos & mpos & cpos & cc & ww & mw & wpos & mP). pose proof curve_on_circle as on.
    pose proof (curve_from_target s s_proper) as fromT. cbv zeta in fromT. fold m c w in fromT.
    unfold curve_x, rl_margin. fold P s m c. intros beyond.
    assert (circle : x * x + (y + 1) * (y + 1) = P) by reflexivity.
    assert (xa : 0 <= m * c) by nra.
    assert (low : y <= m * s).
    { apply (lower_to_the_right (m * c) (m * s) x y); try nra. unfold outer_sq at 1. rewrite on. reflexivity. }
    assert (qx : range_sq x y = P - 4 * y) by (unfold range_sq; lra).
    assert (qa : range_sq (m * c) (m * s) = P - 4 * (m * s)) by (unfold range_sq; lra).
    replace (x * x + y * y - y) with (P - 3 * y - 1) by lra.
    pose proof (sqrt_pos (16 - range_sq x y)) as v0.
    assert (r0 : 0 <= range x y) by apply sqrt_pos.
    destruct (Rle_dec 0 (P - 3 * y - 1)) as [easy|hard].
    - assert (0 <= (P - 3 * y - 1) * sqrt (16 - range_sq x y)) by (apply Rmult_le_pos; assumption).
      assert (0 <= range x y * x) by (apply Rmult_le_pos; lra). lra.
    - assert (nearer : range (m * c) (m * s) <= range x y)
        by (unfold range; apply sqrt_le_1_alt; rewrite qx, qa; lra).
      assert (smaller : sqrt (16 - range_sq x y) <= sqrt (16 - range_sq (m * c) (m * s)))
        by (apply sqrt_le_1_alt; rewrite qx, qa; lra).
      assert (ra : 0 <= range (m * c) (m * s)) by apply sqrt_pos.
      set (r := range x y) in *. set (v := sqrt (16 - range_sq x y)) in *.
      set (r' := range (m * c) (m * s)) in *. set (v' := sqrt (16 - range_sq (m * c) (m * s))) in *.
      assert (e1 : 3 * r' * (m * c) = m * (w - 2 * s) * v').
      { replace (3 * r' * (m * c)) with (m * (3 * r' * c)) by ring. rewrite fromT. ring. }
      assert (e2 : m * (w - 2 * s) = 3 * (m * s) + 1 - P) by (rewrite <- mP, mw; ring).
      assert (3 * r' * (m * c) <= 3 * r * x) by (apply Rmult_le_compat; lra).
      assert ((3 * y + 1 - P) * v <= (3 * (m * s) + 1 - P) * v') by (apply Rmult_le_compat; lra).
      rewrite e2 in e1. lra.
  Qed.

  (** The arcs of LRL before and after the middle one have no negative duration, and the middle one is at least [PI]. *)
  Lemma arcs_at_least : PI <= arcs s.
  Proof.
    destruct facts as (spos & mpos & cpos & cc & ww & mw & wpos & mP).
    assert (nonneg : forall k, 0 <= k -> 0 <= turn_to k s).
    { intros k kpos. unfold turn_to. rewrite <- atan_0. fold c.
      assert (0 <= k * c / (1 + k * s)) by (apply Rmult_le_pos; [nra|left; apply Rinv_0_lt_compat; nra]).
      destruct (Req_dec 0 (k * c / (1 + k * s))) as [<-|differ]; [lra|]. left. apply atan_increasing. lra. }
    pose proof (asin_bound s). pose proof (nonneg m mpos). pose proof (nonneg (w - s) ltac:(lra)).
    unfold arcs. fold m w. lra.
  Qed.
End Switching.

(** A point on the switching curve is where the first arc of LRL vanishes. *)
Lemma point_on_curve x y : 0 <= y -> outer_sq x y < 4 -> x = curve_x (outer_sq x y) -> y = curve_y (outer_sq x y).
Proof.
  intros up inside on. destruct (facts x y up inside) as (spos & mpos & cpos & _ & _ & _ & _ & _).
  pose proof (curve_on_circle x y up inside) as circle. unfold curve_x, curve_y in *.
  set (P := outer_sq x y) in *. assert (same : x * x + (y + 1) * (y + 1) = P) by reflexivity.
  assert (0 <= m_of (s_of P) * s_of P) by nra. rewrite <- on in circle. nra.
Qed.

Lemma off_axis_right x y : 0 <= x -> 0 < x \/ y <> 1 -> off_axis x y.
Proof.
  intros right other. apply off_cut_intro. unfold ahead, aside. pose proof sqrt3_bounds. pose proof sqrt3_sq.
  destruct (Req_dec (- (sqrt 3 / 2 * x) + (y - 1) / 2) 0) as [zero|differ]; [left|right; exact differ].
  assert (Y : y - 1 = sqrt 3 * x) by lra. rewrite Y.
  replace (x / 2 + sqrt 3 / 2 * (sqrt 3 * x)) with ((1 + sqrt 3 * sqrt 3) / 2 * x) by field. rewrite sqrt3_sq.
  destruct other as [pos|high]; [lra|]. destruct (Req_dec x 0) as [->|differ]; [exfalso; lra|lra].
Qed.

(** On the switching curve LRL is RL. *)
Lemma times_on_curve x y : 0 <= y -> outer_sq x y < 4 -> x = curve_x (outer_sq x y) -> time_lrl x y = time_rl x y.
Proof.
  intros up inside on. pose proof (point_on_curve x y up inside on) as ony.
  destruct (facts x y up inside) as (spos & mpos & cpos & cc & ww & mw & wpos & mP).
  destruct (curve_angles _ (s_proper x y up inside)) as (r4 & db & last & cb & sb).
  unfold curve_x, curve_y in on, ony. unfold time_lrl, time_rl, arcs. rewrite (outer_angle_above x y) by lra.
  set (P := outer_sq x y) in *. set (s := s_of P) in *. set (c := c_of s) in *. set (m := m_of s) in *.
  set (w := w_of s) in *. rewrite <- on, <- ony in *.
  assert (xpos : 0 <= x) by (rewrite on; nra).
  assert (off : off_axis x y).
  { apply off_axis_right; [exact xpos|]. destruct (Req_dec y 1) as [->|differ]; [left|right; exact differ].
    destruct (Req_dec x 0) as [zero|differ]; [|lra]. exfalso.
    assert (P = 4) by (unfold P, outer_sq; rewrite zero; ring). lra. }
  pose proof (off_axis_range _ _ off) as rpos. destruct (polar x y off) as [px py].
  pose proof (angle_of_bounds (ahead x y) (aside x y)) as bounds. fold (bearing x y) in bounds.
  pose proof (asin_bound s) as ab. pose proof PI_RGT_0.
  assert (angle : PI / 3 + bearing x y = asin (range x y / 4) + 2 * asin s - PI).
  { set (th := PI / 3 + bearing x y) in *. assert (right : 0 <= cos th) by nra.
    assert (a0 : 0 <= asin s).
    { apply Rnot_lt_le. intros neg. assert (sin (asin s) < 0) by (apply sin_lt_0_var; lra).
      rewrite sin_asin in H0 by (pose proof (proper_inside s (s_proper x y up inside)); lra). lra. }
    assert (thb : - (PI / 2) <= th <= PI / 2).
    { split; apply Rnot_lt_le; intros beyond.
      - assert (cos (- th) < 0) by (apply cos_lt_0; unfold th in *; lra). rewrite cos_neg in H0. lra.
      - assert (cos th < 0) by (apply cos_lt_0; unfold th in *; lra). lra. }
    apply same_angle.
    - apply Rabs_lt_between. lra.
    - apply Rmult_eq_reg_l with (range x y); [|lra]. rewrite cb, px. reflexivity.
    - apply Rmult_eq_reg_l with (range x y); [|lra]. rewrite sb, py. reflexivity. }
  rewrite last. unfold turn_to at 1. fold c.
  replace (x / (y + 1)) with (m * c / (1 + m * s)) by (rewrite on, ony; f_equal; ring). lra.
Qed.
