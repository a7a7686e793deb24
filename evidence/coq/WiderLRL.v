(** The margin of LRL onto a circle of any radius, where its time has a derivative. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Wider WiderMargin WiderCrossing.
Open Scope R_scope.

(** The parameters of [lrl_time]: the switching points are [(m a, a)] and [(- (m b), b)]. *)
Definition lrl_s (rho x y : R) : R := (lrl_h rho x y + sqrt (lrl_under_root rho x y)) / 3.
Definition lrl_m (rho x y : R) : R := sqrt (2 / lrl_s rho x y - 1).
Definition lrl_a (rho x y : R) : R := (lrl_s rho x y - lrl_d rho x y) / 2.
Definition lrl_b (rho x y : R) : R := (lrl_s rho x y + lrl_d rho x y) / 2.

(** The switching function, up to a positive factor. *)
Definition three_arcs_margin (rho x y : R) : R :=
  outer_sq x y - y - 1 - x * (2 * lrl_a rho x y / lrl_s rho x y + 1) / lrl_m rho x y.

(** The three rotations together: with [d] a quarter of the difference of two squared radii, a polynomial identity. *)
Lemma lrl_rates m d p : 0 < m -> let s := 2 / (1 + m * m) in let a := (s - d) / 2 in let b := (s + d) / 2 in
  let g := (3 * s * s - d * d) / (2 * s) in let s' := p * (2 * s + d) / (4 * g) in let m' := - s' / (s * s * m) in
  let a' := (s' + p / 4) / 2 in let b' := (s' - p / 4) / 2 in g <> 0 ->
  0 < m * a * (m * a) + (a + 1) * (a + 1) -> 0 < m * a * (m * a) + (a - 1) * (a - 1) ->
  0 < m * b * (m * b) + (b + 1) * (b + 1) ->
  - (m * a * a' - (a + 1) * (m' * a + m * a')) / (m * a * (m * a) + (a + 1) * (a + 1))
  + (- (m * b) * b' - (b - 1) * - (m' * b + m * b') - (m * a * a' - (a - 1) * (m' * a + m * a')))
    / (m * a * (m * a) + (a - 1) * (a - 1))
  + (- (m * b) * b' - (b + 1) * - (m' * b + m * b')) / (m * b * (m * b) + (b + 1) * (b + 1))
  = - (p * (2 * a / s + 1) / (2 * m)) / (m * a * (m * a) + (a + 1) * (a + 1)).
Proof.
  intros mpos s a b g s' m' a' b' gn P1 P2 P3. assert (one : 0 < 1 + m * m) by nra.
  assert (spos : 0 < s) by (unfold s; apply Rdiv_lt_0_compat; lra).
  assert (ga : 3 * s * s - d * d <> 0) by (intros z; apply gn; unfold g; rewrite z; field; lra).
  assert (scaled : forall v w, 0 < v -> v * ((1 + m * m) * 2 * ((1 + m * m) * 2)) = w -> w <> 0).
  { intros v w vpos <-. apply Rgt_not_eq. apply Rmult_lt_0_compat; [exact vpos|nra]. }
  assert (ga' : 12 - d * d * ((1 + m * m) * (1 + m * m)) <> 0).
  { intros z. apply ga. unfold s. transitivity ((12 - d * d * ((1 + m * m) * (1 + m * m))) / ((1 + m * m) * (1 + m * m))); [field; lra|].
    rewrite z. field. lra. }
  unfold m', a', b', s', g, a, b in *. clear m' a' b' s' g gn ga. unfold s in *. clear s.
  field. repeat split; try lra; try exact ga'.
  - apply (scaled _ _ P1). field. lra.
  - apply (scaled _ _ P3). field. lra.
  - apply (scaled _ _ P2). field. lra.
Qed.

Lemma off_pole m v w : 0 < m -> w <> 0 -> 0 < m * v * (m * v) + (v + w) * (v + w).
Proof.
  intros mpos wn. pose proof (Rle_0_sqr (v + w)) as high. unfold Rsqr in high. destruct (Req_dec v 0) as [-> | vn].
  - rewrite Rplus_0_l. pose proof (Rsqr_pos_lt w wn) as pos. unfold Rsqr in pos. lra.
  - pose proof (Rsqr_pos_lt (m * v) ltac:(apply Rmult_integral_contrapositive; lra)) as pos. unfold Rsqr in pos. lra.
Qed.

Lemma rd_lrl_time rho x y t u : 1 <= rho -> moves x y t u ->
  0 < lrl_under_root rho (x t) (y t) -> lrl_s rho (x t) (y t) < 2 ->
  ~ (x t = lrl_m rho (x t) (y t) * lrl_a rho (x t) (y t) /\ y t = lrl_a rho (x t) (y t)) ->
  right_derive (fun s => lrl_time rho (x s) (y s)) t (-1 + (1 - u) * three_arcs_margin rho (x t) (y t) / outer_sq (x t) (y t)).
Proof.
  intros wide mv root narrow apart. pose proof (rd_outer_sq _ _ _ _ mv) as rP. destruct mv as [ub [rx ry]].
  set (p := 2 * (1 - u) * x t) in *.
  set (h := fun s => lrl_h rho (x s) (y s)). set (d := fun s => lrl_d rho (x s) (y s)).
  set (s_ := fun s => lrl_s rho (x s) (y s)). set (m := fun s => lrl_m rho (x s) (y s)).
  set (a := fun s => lrl_a rho (x s) (y s)). set (b := fun s => lrl_b rho (x s) (y s)).
  set (D := fun s => lrl_under_root rho (x s) (y s)). set (g := sqrt (D t)).
  assert (gpos : 0 < g) by (apply sqrt_lt_R0; exact root).
  assert (gg : g * g = D t) by (apply sqrt_sqrt; unfold D; lra).
  assert (rh : right_derive h t (p / 2)).
  { unfold h, lrl_h. pose proof (rd_scal (/ 2) _ _ _ (rd_plus _ _ _ _ _ (rd_const (rho * (rho + 2) - 1) t) rP)) as r. simpl in r.
    apply (rd_ext (fun s => / 2 * (rho * (rho + 2) - 1 + outer_sq (x s) (y s)))); [intros; field|].
    replace (p / 2) with (/ 2 * (0 + p)) by field. exact r. }
  assert (rd : right_derive d t (- p / 4)).
  { unfold d, lrl_d. pose proof (rd_scal (/ 4) _ _ _ (rd_minus _ _ _ _ _ (rd_const (rho * (rho + 2) + 1) t) rP)) as r. simpl in r.
    apply (rd_ext (fun s => / 4 * (rho * (rho + 2) + 1 - outer_sq (x s) (y s)))); [intros; field|].
    replace (- p / 4) with (/ 4 * (0 - p)) by field. exact r. }
  assert (rD : right_derive D t (p * (h t + 3 / 2 * d t))).
  { pose proof (rd_minus _ _ _ _ _ (rd_square _ _ _ rh) (rd_scal 3 _ _ _ (rd_square _ _ _ rd))) as r. simpl in r.
    apply (rd_ext (fun s => h s * h s - 3 * (d s * d s))); [intros; unfold D, lrl_under_root, h, d; ring|].
    match type of r with right_derive _ _ ?v => replace (p * (h t + 3 / 2 * d t)) with v; [exact r|field] end. }
  assert (st : 3 * s_ t = h t + g) by (unfold s_, lrl_s, h, g, D; field).
  set (s' := p * (2 * s_ t + d t) / (4 * g)).
  assert (rs : right_derive s_ t s').
  { pose proof (rd_scal (/ 3) _ _ _ (rd_plus _ _ _ _ _ rh (rd_sqrt D t _ root rD))) as r. simpl in r. fold g in r.
    apply (rd_ext (fun s => / 3 * (h s + sqrt (D s)))); [intros; unfold s_, lrl_s, h, D; field|].
    match type of r with right_derive _ _ ?v => replace s' with v; [exact r|] end.
    unfold s'. replace (h t) with (3 * s_ t - g) by lra. field. lra. }
  assert (hpos : 0 < h t).
  { unfold h, lrl_h, outer_sq. pose proof (Rle_0_sqr (x t)). pose proof (Rle_0_sqr (y t + 1)). unfold Rsqr in *. nra. }
  assert (spos : 0 < s_ t) by lra. change (lrl_s rho (x t) (y t)) with (s_ t) in narrow.
  assert (mm : m t * m t = 2 / s_ t - 1).
  { apply sqrt_sqrt. change (lrl_s rho (x t) (y t)) with (s_ t). apply Rmult_le_reg_r with (s_ t); [exact spos|].
    replace ((2 / s_ t - 1) * s_ t) with (2 - s_ t) by (field; lra). lra. }
  assert (inside : 0 < 2 / s_ t - 1).
  { apply Rmult_lt_reg_r with (s_ t); [exact spos|]. replace ((2 / s_ t - 1) * s_ t) with (2 - s_ t) by (field; lra). lra. }
  assert (mpos : 0 < m t) by (apply sqrt_lt_R0; exact inside).
  set (m' := - s' / (s_ t * s_ t * m t)).
  assert (rm : right_derive m t m').
  { pose proof (rd_minus _ _ _ _ _ (rd_div (fun _ => 2) s_ t _ _ ltac:(lra) (rd_const 2 t) rs) (rd_const 1 t)) as r. simpl in r.
    pose proof (rd_sqrt (fun s => 2 / s_ s - 1) t _ inside r) as rr. simpl in rr.
    match type of rr with right_derive _ _ ?v => replace m' with v; [exact rr|] end.
    change (sqrt (2 / s_ t - 1)) with (m t). unfold m'. field. lra. }
  set (a' := (s' + p / 4) / 2). set (b' := (s' - p / 4) / 2).
  assert (ra : right_derive a t a').
  { pose proof (rd_scal (/ 2) _ _ _ (rd_minus _ _ _ _ _ rs rd)) as r. simpl in r.
    apply (rd_ext (fun s => / 2 * (s_ s - d s))); [intros; unfold a, lrl_a, s_, d; field|].
    match type of r with right_derive _ _ ?v => replace a' with v; [exact r|unfold a'; field] end. }
  assert (rb : right_derive b t b').
  { pose proof (rd_scal (/ 2) _ _ _ (rd_plus _ _ _ _ _ rs rd)) as r. simpl in r.
    apply (rd_ext (fun s => / 2 * (s_ s + d s))); [intros; unfold b, lrl_b, s_, d; field|].
    match type of r with right_derive _ _ ?v => replace b' with v; [exact r|unfold b'; field] end. }
  (* The circles of the three arcs, through the switching points. *)
  assert (at_ : a t = (s_ t - d t) / 2) by reflexivity. assert (bt : b t = (s_ t + d t) / 2) by reflexivity.
  assert (quadratic : 3 * s_ t * s_ t + d t * d t = 2 * h t * s_ t).
  { assert (gg' : (3 * s_ t - h t) * (3 * s_ t - h t) = h t * h t - 3 * d t * d t)
      by (replace (3 * s_ t - h t) with g by lra; rewrite gg; reflexivity). nra. }
  set (P := outer_sq (x t) (y t)) in *.
  assert (hP : 2 * h t = rho * (rho + 2) + P - 1) by (unfold h, lrl_h; fold P; field).
  assert (dP : 4 * d t = rho * (rho + 2) - P + 1) by (unfold d, lrl_d; fold P; field).
  assert (first : m t * a t * (m t * a t) + (a t + 1) * (a t + 1) = P).
  { replace (m t * a t * (m t * a t)) with (m t * m t * (a t * a t)) by ring. rewrite mm.
    transitivity (2 * (a t * a t) / s_ t + 2 * a t + 1); [field; lra|]. rewrite at_.
    apply Rmult_eq_reg_r with (2 * s_ t); [|lra]. field_simplify; [|lra]. nra. }
  assert (last : m t * b t * (m t * b t) + (b t + 1) * (b t + 1) = (rho + 1) * (rho + 1)).
  { replace (m t * b t * (m t * b t)) with (m t * m t * (b t * b t)) by ring. rewrite mm.
    transitivity (2 * (b t * b t) / s_ t + 2 * b t + 1); [field; lra|]. rewrite bt.
    apply Rmult_eq_reg_r with (2 * s_ t); [|lra]. field_simplify; [|lra]. nra. }
  assert (middle : m t * a t * (m t * a t) + (a t - 1) * (a t - 1)
      = - (m t * b t) * - (m t * b t) + (b t - 1) * (b t - 1)).
  { transitivity (P - 4 * a t); [lra|]. transitivity ((rho + 1) * (rho + 1) - 4 * b t); [|lra]. rewrite at_, bt. lra. }
  assert (pos1 := off_pole (m t) (a t) 1 mpos ltac:(lra)). assert (pos2 := off_pole (m t) (a t) (-1) mpos ltac:(lra)).
  assert (pos3 := off_pole (m t) (b t) 1 mpos ltac:(lra)). replace (a t + -1) with (a t - 1) in pos2 by ring.
  assert (Ppos : 0 < P) by lra.
  pose proof (rd_mult _ _ _ _ _ rm ra) as rxa. simpl in rxa. pose proof (rd_opp _ _ _ (rd_mult _ _ _ _ _ rm rb)) as rxb. simpl in rxb.
  pose proof (rd_plus _ _ _ _ _ ry (rd_const 1 t)) as ry1. pose proof (rd_plus _ _ _ _ _ ra (rd_const 1 t)) as ra1.
  pose proof (rd_plus _ _ _ _ _ rb (rd_const 1 t)) as rb1. pose proof (rd_minus _ _ _ _ _ ra (rd_const 1 t)) as ra2.
  pose proof (rd_minus _ _ _ _ _ rb (rd_const 1 t)) as rb2. simpl in ry1, ra1, rb1, ra2, rb2.
  assert (start : x t * x t + (y t + 1) * (y t + 1) = P) by reflexivity.
  pose proof (rd_rotation (fun s => m s * a s) (fun s => a s + 1) x (fun s => y s + 1) t _ _ _ _ rxa ra1 rx ry1) as r1.
  pose proof (rd_rotation (fun s => m s * a s) (fun s => a s - 1) (fun s => - (m s * b s)) (fun s => b s - 1) t _ _ _ _
    rxa ra2 rxb rb2) as r2.
  pose proof (rd_rotation (fun _ => 0) (fun _ => rho + 1) (fun s => - (m s * b s)) (fun s => b s + 1) t _ _ _ _
    (rd_const 0 t) (rd_const _ t) rxb rb1) as r3.
  cbv beta in r1, r2, r3.
  specialize (r1 ltac:(apply apart_off_cut; [lra|lra|intros [e1 e2]; apply apart; split; [symmetry; exact e1|change (y t = a t); lra]])).
  specialize (r2 ltac:(apply apart_off_cut; [exact middle|exact pos2|intros [e1 e2]; assert (a t = b t) by lra;
    assert (zero : m t * a t = 0) by (replace (b t) with (a t) in e1 by assumption; lra);
    destruct (Rmult_integral _ _ zero); [lra|rewrite at_, bt in *; lra]])).
  specialize (r3 ltac:(apply apart_off_cut; [lra|nra|intros [e1 e2]; assert (zero : m t * b t = 0) by lra;
    destruct (Rmult_integral _ _ zero); [lra|lra]])).
  pose proof (rd_plus _ _ _ _ _ (rd_plus _ _ _ _ _ r1 r2) r3) as rate. cbv beta in rate.
  assert (same : forall s, t <= s ->
      rotation (m s * a s * x s + (a s + 1) * (y s + 1)) (m s * a s * (y s + 1) - (a s + 1) * x s)
      + rotation (m s * a s * - (m s * b s) + (a s - 1) * (b s - 1)) (m s * a s * (b s - 1) - (a s - 1) * - (m s * b s))
      + rotation (0 * - (m s * b s) + (rho + 1) * (b s + 1)) (0 * (b s + 1) - (rho + 1) * - (m s * b s))
    = lrl_time rho (x s) (y s)).
  { intros s _. unfold lrl_time, right_turn, left_turn. cbv zeta.
    change (sqrt (2 / ((lrl_h rho (x s) (y s) + sqrt (lrl_under_root rho (x s) (y s))) / 3) - 1)) with (m s).
    change (((lrl_h rho (x s) (y s) + sqrt (lrl_under_root rho (x s) (y s))) / 3 - lrl_d rho (x s) (y s)) / 2) with (a s).
    change (((lrl_h rho (x s) (y s) + sqrt (lrl_under_root rho (x s) (y s))) / 3 + lrl_d rho (x s) (y s)) / 2) with (b s).
    f_equal; [f_equal|]; f_equal; ring. }
  pose proof (rd_ext _ _ _ _ same rate) as R. clear rate.
  match type of R with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w => replace w with v; [exact R|] end end.
  clear R r1 r2 r3 same.
  assert (sm : 2 / (1 + m t * m t) = s_ t) by (rewrite mm; field; lra).
  assert (sg : (3 * s_ t * s_ t - d t * d t) / (2 * s_ t) = g).
  { apply Rmult_eq_reg_r with (2 * s_ t); [|lra]. field_simplify; [|lra]. replace g with (3 * s_ t - h t) by lra. nra. }
  pose proof (lrl_rates (m t) (d t) p mpos) as sum. cbv zeta in sum. rewrite sm in sum. rewrite sg in sum.
  fold s' in sum. fold m' in sum. fold a' b' in sum. rewrite <- at_, <- bt in sum.
  specialize (sum ltac:(lra) pos1 pos2 pos3).
  unfold three_arcs_margin. fold P. change (lrl_m rho (x t) (y t)) with (m t). change (lrl_a rho (x t) (y t)) with (a t).
  change (lrl_s rho (x t) (y t)) with (s_ t).
  transitivity ((x t * - (u * x t) - (y t + 1) * (1 + u * y t)) / P
    + - (p * (2 * a t / s_ t + 1) / (2 * m t)) / (m t * a t * (m t * a t) + (a t + 1) * (a t + 1))).
  - rewrite <- sum, <- middle, start. replace (- (m t * b t) * - (m t * b t)) with (m t * b t * (m t * b t)) by ring.
    unfold Rdiv. ring.
  - rewrite first. assert (plane : x t * x t = P - (y t + 1) * (y t + 1)) by lra. unfold p. clearbody P.
    field [plane]. repeat split; lra.
Qed.

(** Where the root is not 0 and the first arc does not end at its start: if the margin is not negative, no control makes the
    time of LRL fall faster than time passes. *)
Definition lrl_inside (rho x y : R) : Prop :=
  0 < lrl_under_root rho x y /\ lrl_s rho x y < 2 /\ ~ (x = lrl_m rho x y * lrl_a rho x y /\ y = lrl_a rho x y).

Theorem lrl_margin_holds rho x y : 1 <= rho -> exists_at LRL rho x y -> lrl_inside rho x y -> 0 <= three_arcs_margin rho x y ->
  margin_holds (time_of LRL rho) x y.
Proof.
  intros wide _ (root & narrow & apart) nonneg. set (M := three_arcs_margin rho x y / outer_sq x y).
  assert (0 <= outer_sq x y).
  { unfold outer_sq. pose proof (Rle_0_sqr x). pose proof (Rle_0_sqr (y + 1)). unfold Rsqr in *. lra. }
  assert (0 <= M).
  { unfold M, Rdiv. destruct (Req_dec (outer_sq x y) 0) as [-> | differ]; [rewrite Rinv_0; lra|].
    apply Rmult_le_pos; [exact nonneg|left; apply Rinv_0_lt_compat; lra]. }
  exists (1 - M), M. split; [rewrite Rabs_right by lra; ring|]. intros X Y t u <- <- mv.
  replace (- (1 - M + u * M)) with (-1 + (1 - u) * three_arcs_margin rho (X t) (Y t) / outer_sq (X t) (Y t)) by (unfold M, Rdiv; ring).
  exact (rd_lrl_time rho X Y t u wide mv root narrow apart).
Qed.
