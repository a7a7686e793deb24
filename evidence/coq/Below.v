(** Maneuvers from below the axis, within the last circle, at [R = 1]: right to one of the two crossings with the last
    circle, then left. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Nearby.
Open Scope R_scope.

(** The angle of the state, seen from the target, to the right of straight below. *)
Definition lower_angle (x y : R) : R := atan (x / (1 - y)).

(** RL with the left and with the right crossing. *)
Definition time_rl_left (x y : R) : R := 3 * PI / 2 - lower_angle x y + 3 * asin (range x y / 4).
Definition time_rl_right (x y : R) : R := 5 * PI / 2 - lower_angle x y - 3 * asin (range x y / 4).

Lemma range_below x y : y < 1 -> 0 < range_sq x y /\ 0 < range x y.
Proof.
  intros below. assert (0 < range_sq x y) by (unfold range_sq; nra). split; [assumption|apply sqrt_lt_R0; assumption].
Qed.

Lemma lower_polar x y : y < 1 ->
  range x y * sin (lower_angle x y) = x /\ range x y * cos (lower_angle x y) = 1 - y.
Proof.
  intros below. unfold lower_angle. rewrite sin_atan, cos_atan. unfold Rsqr.
  pose proof (range_range x y) as rr. destruct (range_below x y below) as [qpos rpos].
  assert (root : sqrt (1 + x / (1 - y) * (x / (1 - y))) = range x y / (1 - y)).
  { apply sqrt_lem_1; [|left; apply Rdiv_lt_0_compat; lra|].
    - pose proof (pow2_ge_0 (x / (1 - y))). lra.
    - replace (range x y / (1 - y) * (range x y / (1 - y))) with (range x y * range x y / ((1 - y) * (1 - y))) by (field; lra).
      rewrite rr. unfold range_sq. field. lra. }
  rewrite root. split; field; lra.
Qed.

Lemma rd_lower_angle x y t u : moves x y t u -> y t < 1 ->
  right_derive (fun s => lower_angle (x s) (y s)) t
    (1 - (1 + u) * (x t * x t + y t * y t - y t) / range_sq (x t) (y t)).
Proof.
  intros [_ [rx ry]] below. pose proof (rd_minus _ _ _ _ _ (rd_const 1 t) ry) as r1. simpl in r1.
  pose proof (rd_atan _ _ _ (rd_div x (fun v => 1 - y v) t _ _ ltac:(lra) rx r1)) as ra. simpl in ra. unfold lower_angle.
  match type of ra with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
    replace g with v; [exact ra|] end end.
  unfold range_sq. field. repeat split; nra.
Qed.

Lemma rd_asin_range x y t u : moves x y t u -> 0 < range_sq (x t) (y t) < 16 ->
  right_derive (fun s => asin (range (x s) (y s) / 4)) t
    ((1 + u) * x t / (range (x t) (y t) * sqrt (16 - range_sq (x t) (y t)))).
Proof.
  intros mv near. pose proof (range_range (x t) (y t)) as rr.
  assert (rpos : 0 < range (x t) (y t)) by (apply sqrt_lt_R0; lra).
  pose proof (rd_sqrt _ t _ (proj1 near) (rd_range_sq _ _ _ _ mv)) as rg.
  pose proof (rd_scal (/ 4) _ _ _ rg) as rq. simpl in rq.
  assert (inside : -1 < / 4 * sqrt (range_sq (x t) (y t)) < 1) by (fold (range (x t) (y t)); nra).
  pose proof (rd_comp asin (fun s => / 4 * sqrt (range_sq (x s) (y s))) t _ _ (is_derive_asin _ inside) rq) as ra.
  apply (rd_ext _ (fun s => asin (range (x s) (y s) / 4))) in ra.
  2:{ intros s _. unfold range. f_equal. field. }
  match type of ra with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact ra|] end end.
  fold (range (x t) (y t)). set (r := range (x t) (y t)) in *. set (q := range_sq (x t) (y t)) in *.
  assert (root : sqrt (1 - / 4 * r * (/ 4 * r)) = sqrt (16 - q) / 4).
  { apply sqrt_lem_1; [nra|apply Rmult_le_pos; [apply sqrt_pos|lra]|].
    replace (sqrt (16 - q) / 4 * (sqrt (16 - q) / 4)) with (sqrt (16 - q) * sqrt (16 - q) / 16) by field.
    rewrite sqrt_sqrt by lra. lra. }
  rewrite root. assert (0 < sqrt (16 - q)) by (apply sqrt_lt_R0; lra). field. lra.
Qed.

(** The switching function of RL with the right crossing; with the left crossing it is [rl_margin]. *)
Definition rl_right_margin (x y : R) : R :=
  (x * x + y * y - y) * sqrt (16 - range_sq x y) - 3 * range x y * x.

Lemma rd_time_rl_left x y t u : moves x y t u -> y t < 1 -> range_sq (x t) (y t) < 16 ->
  right_derive (fun s => time_rl_left (x s) (y s)) t
    (- 1 + (1 + u) * rl_margin (x t) (y t) / (range_sq (x t) (y t) * sqrt (16 - range_sq (x t) (y t)))).
Proof.
  intros mv below near. destruct (range_below (x t) (y t) below) as [qpos rpos].
  pose proof (range_range (x t) (y t)) as rr. assert (0 < sqrt (16 - range_sq (x t) (y t))) by (apply sqrt_lt_R0; lra).
  pose proof (rd_plus _ _ _ _ _ (rd_minus _ _ _ _ _ (rd_const (3 * PI / 2) t) (rd_lower_angle _ _ _ _ mv below))
    (rd_scal 3 _ _ _ (rd_asin_range _ _ _ _ mv (conj qpos near)))) as rt. simpl in rt.
  match type of rt with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rt|] end end.
  unfold rl_margin. rewrite <- rr in *. field. split; lra.
Qed.

Lemma rd_time_rl_right x y t u : moves x y t u -> y t < 1 -> range_sq (x t) (y t) < 16 ->
  right_derive (fun s => time_rl_right (x s) (y s)) t
    (- 1 + (1 + u) * rl_right_margin (x t) (y t) / (range_sq (x t) (y t) * sqrt (16 - range_sq (x t) (y t)))).
Proof.
  intros mv below near. destruct (range_below (x t) (y t) below) as [qpos rpos].
  pose proof (range_range (x t) (y t)) as rr. assert (0 < sqrt (16 - range_sq (x t) (y t))) by (apply sqrt_lt_R0; lra).
  pose proof (rd_minus _ _ _ _ _ (rd_minus _ _ _ _ _ (rd_const (5 * PI / 2) t) (rd_lower_angle _ _ _ _ mv below))
    (rd_scal 3 _ _ _ (rd_asin_range _ _ _ _ mv (conj qpos near)))) as rt. simpl in rt.
  match type of rt with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rt|] end end.
  unfold rl_right_margin. rewrite <- rr in *. field. split; lra.
Qed.

(** ** The signs of the margins *)

(** Its sign says, together with that of [outer_sq - 4], where the margins vanish on the circle about [(0, -1)] whose
    squared radius is [P]: on the switching curve and at another point. *)
Definition tangency (P y : R) : R := (10 * P - 64) * (y - 1) - 24 * (y - 1) * (y - 1) + (P - 4) * (11 - P).

Lemma margin_squares x y :
  (x * x + y * y - y) * (x * x + y * y - y) * (16 - range_sq x y) - 9 * range_sq x y * (x * x)
    = (outer_sq x y - 4) * tangency (outer_sq x y) y.
Proof. unfold tangency, outer_sq, range_sq. ring. Qed.

Section Signs.
  Variables x y : R.
  Hypothesis inside : outer_sq x y < 4.
  Hypothesis near : range_sq x y < 16.
  Let E := x * x + y * y - y.
  Let r := range x y.
  Let v := sqrt (16 - range_sq x y).

  Lemma root_facts : 0 <= r /\ r * r = range_sq x y /\ 0 < v /\ v * v = 16 - range_sq x y
    /\ (E * v) * (E * v) - (3 * r * x) * (3 * r * x) = (outer_sq x y - 4) * tangency (outer_sq x y) y.
  Proof.
    assert (vv : v * v = 16 - range_sq x y) by (apply sqrt_sqrt; lra).
    pose proof (range_range x y) as rr. fold r in rr.
    repeat split; [apply sqrt_pos|exact rr|apply sqrt_lt_R0; lra|exact vv|].
    rewrite <- margin_squares. fold E.
    replace ((E * v) * (E * v)) with (E * E * (v * v)) by ring. rewrite vv.
    replace ((3 * r * x) * (3 * r * x)) with (9 * (r * r) * (x * x)) by ring. rewrite rr. reflexivity.
  Qed.

  Lemma rl_margin_below : y <= 0 -> 0 <= x \/ tangency (outer_sq x y) y <= 0 -> 0 <= rl_margin x y.
  Proof.
    intros down side. destruct root_facts as (r0 & rr & v0 & vv & squares).
    unfold rl_margin. fold E r v. assert (E0 : 0 <= E) by (unfold E; nra). assert (0 <= E * v) by nra.
    destruct (Rle_dec 0 x) as [right|left]; [assert (0 <= r * x) by nra; lra|].
    destruct side as [ge|sign]; [lra|]. apply Rnot_lt_le. intros neg.
    assert (0 <= (outer_sq x y - 4) * tangency (outer_sq x y) y) by nra. nra.
  Qed.

  Lemma rl_right_margin_below : y <= 0 -> 4 <= range_sq x y -> 0 <= rl_right_margin x y.
  Proof.
    intros down far. destruct root_facts as (r0 & rr & v0 & vv & squares).
    unfold rl_right_margin. fold E r v. assert (E0 : 0 <= E) by (unfold E; nra). assert (0 <= E * v) by nra.
    destruct (Rle_dec x 0) as [left|right]; [assert (0 <= r * - x) by nra; lra|].
    assert (sign : tangency (outer_sq x y) y <= 0).
    { replace (tangency (outer_sq x y) y) with ((4 + 2 * range_sq x y) * (y - 1) + range_sq x y * (7 - range_sq x y))
        by (unfold tangency, outer_sq, range_sq; ring).
      assert (0 <= (range_sq x y - 1) * (range_sq x y - 4)) by (apply Rmult_le_pos; lra). nra. }
    assert (0 <= (outer_sq x y - 4) * tangency (outer_sq x y) y) by nra.
    apply Rnot_lt_le. intros neg. nra.
  Qed.

  Lemma rl_margin_negative :
    (x < 0 /\ 0 < tangency (outer_sq x y) y) \/ (E < 0 /\ tangency (outer_sq x y) y < 0) \/ (x < 0 /\ y < 1 /\ E <= 0) ->
    rl_margin x y < 0.
  Proof.
    destruct root_facts as (r0 & rr & v0 & vv & squares). unfold rl_margin. fold E r v. intros cases.
    apply Rnot_le_lt. intros nonneg. destruct cases as [[left sign]|[[neg sign]|[left [lower neg]]]].
    - assert ((outer_sq x y - 4) * tangency (outer_sq x y) y < 0) by nra.
      assert (0 <= r * - x) by nra. nra.
    - assert (0 < (outer_sq x y - 4) * tangency (outer_sq x y) y) by nra. assert (E * v < 0) by nra. nra.
    - assert (rpos : 0 < r) by (apply (range_below x y lower)). assert (r * x < 0) by nra. assert (E * v <= 0) by nra. lra.
  Qed.
End Signs.

(** ** Along a left turn *)

Lemma arc_moves h t : moves (fun v => h * sin v) (fun v => h * cos v - 1) t 1.
Proof. split; [lra|]. split; apply rd_of_derive; auto_derive; try exact I; ring. Qed.

Lemma arc_circle h t : outer_sq (h * sin t) (h * cos t - 1) = h * h.
Proof. unfold outer_sq. pose proof (sin2_cos2 t) as one. unfold Rsqr in one. nra. Qed.

Lemma arc_range h t : 0 < h < 2 -> h * cos t - 1 < 1 /\ range_sq (h * sin t) (h * cos t - 1) < 16.
Proof.
  intros hb. pose proof (COS_bound t). assert (low : - h <= h * cos t <= h) by nra. split; [lra|].
  pose proof (arc_circle h t) as on. unfold outer_sq, range_sq in *. nra.
Qed.

Section FilterBelow.
  Context {F : (R -> Prop) -> Prop} {FF : Filter F}.
  Variables (x y : R -> R) (x0 y0 : R).
  Hypothesis lx : filterlim x F (locally x0).
  Hypothesis ly : filterlim y F (locally y0).

  Lemma fl_lower_angle : y0 < 1 -> filterlim (fun s => lower_angle (x s) (y s)) F (locally (lower_angle x0 y0)).
  Proof.
    intros below. unfold lower_angle. apply (fl_derive atan (fun s => x s / (1 - y s)) _ _ (is_derive_atan _)).
    apply fl_mult; [exact lx|]. apply fl_inv; [lra|]. apply fl_minus; [apply fl_const|exact ly].
  Qed.

  Lemma fl_asin_range : range_sq x0 y0 < 16 ->
    filterlim (fun s => asin (range (x s) (y s) / 4)) F (locally (asin (range x0 y0 / 4))).
  Proof.
    intros near. pose proof (range_range x0 y0). pose proof (sqrt_pos (range_sq x0 y0)) as r0.
    fold (range x0 y0) in r0. assert (bounds : -1 < range x0 y0 / 4 < 1) by (split; nra).
    apply (fl_derive asin (fun s => range (x s) (y s) / 4) _ _ (is_derive_asin _ bounds)).
    apply fl_mult; [|apply fl_const]. unfold range. apply fl_sqrt; [apply range_sq_nonneg|exact (fl_range_sq x y x0 y0 lx ly)].
  Qed.

  Lemma fl_time_rl_left : y0 < 1 -> range_sq x0 y0 < 16 ->
    filterlim (fun s => time_rl_left (x s) (y s)) F (locally (time_rl_left x0 y0)).
  Proof.
    intros below near. unfold time_rl_left. apply fl_plus; [apply fl_minus; [apply fl_const|apply fl_lower_angle, below]|].
    apply fl_scal, fl_asin_range, near.
  Qed.

  Lemma fl_time_rl_right : y0 < 1 -> range_sq x0 y0 < 16 ->
    filterlim (fun s => time_rl_right (x s) (y s)) F (locally (time_rl_right x0 y0)).
  Proof.
    intros below near. unfold time_rl_right. apply fl_minus; [apply fl_minus; [apply fl_const|apply fl_lower_angle, below]|].
    apply fl_scal, fl_asin_range, near.
  Qed.
End FilterBelow.

(** The duration of RL after a left turn, as a function of the angle where that turn ends; [k] allows for a slope. *)
Definition turned (h k t : R) : R := time_rl_left (h * sin t) (h * cos t - 1) + t + k * (h * cos t - 1).

Definition turned_rate (h k t : R) : R :=
  let x := h * sin t in let y := h * cos t - 1 in
  2 * rl_margin x y / (range_sq x y * sqrt (16 - range_sq x y)) - k * x.

Lemma rd_turned h k t : 0 < h < 2 -> right_derive (turned h k) t (turned_rate h k t).
Proof.
  intros hb. destruct (arc_range h t hb) as [below near]. unfold turned, turned_rate. pose proof (arc_moves h t) as mv.
  pose proof (rd_plus _ _ _ _ _ (rd_plus _ _ _ _ _ (rd_time_rl_left _ _ t 1 mv below near) (rd_id t))
    (rd_scal k _ _ _ (proj2 (proj2 mv)))) as rd. simpl in rd.
  match type of rd with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rd|] end end.
  simpl. field. destruct (range_below (h * sin t) _ below). split; [|lra]. apply Rgt_not_eq, sqrt_lt_R0. lra.
Qed.

Lemma lc_turned h k t : 0 < h < 2 -> left_continuous (turned h k) t.
Proof.
  intros hb. destruct (arc_range h t hb) as [below near].
  assert (lx : left_continuous (fun v => h * sin v) t) by (apply (lc_of_derive _ t (h * cos t)); auto_derive; [exact I|ring]).
  assert (ly : left_continuous (fun v => h * cos v - 1) t) by (apply (lc_of_derive _ t (- (h * sin t))); auto_derive; [exact I|ring]).
  unfold turned, left_continuous. apply fl_plus; [apply fl_plus; [|apply lc_id]|].
  - exact (fl_time_rl_left (fun v => h * sin v) (fun v => h * cos v - 1) _ _ lx ly below near).
  - apply fl_scal, ly.
Qed.

Lemma turned_rises h k a b : 0 < h < 2 -> a <= b -> (forall t, a <= t < b -> 0 <= turned_rate h k t) ->
  turned h k a <= turned h k b.
Proof.
  intros hb ab up. apply never_falls_continuous; [exact ab| |].
  - intros t _. apply lc_turned, hb.
  - intros t inside. exists (turned_rate h k t). split; [apply up, inside|apply rd_turned, hb].
Qed.

Lemma turned_falls h a b : 0 < h < 2 -> a < b ->
  (forall t, a <= t < b -> rl_margin (h * sin t) (h * cos t - 1) < 0) -> turned h 0 b < turned h 0 a.
Proof.
  intros hb ab down.
  assert (rate : forall t, a <= t < b -> turned_rate h 0 t < 0).
  { intros t inside. destruct (arc_range h t hb) as [below near]. destruct (range_below (h * sin t) _ below) as [qpos _].
    unfold turned_rate. specialize (down t inside).
    assert (0 < sqrt (16 - range_sq (h * sin t) (h * cos t - 1))) by (apply sqrt_lt_R0; lra).
    set (den := range_sq (h * sin t) (h * cos t - 1) * sqrt (16 - range_sq (h * sin t) (h * cos t - 1))).
    assert (0 < / den) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
    unfold Rdiv. nra. }
  pose proof (rate a ltac:(lra)) as first.
  destruct (rd_turned h 0 a hb (- turned_rate h 0 a / 2)) as [d [dpos H]]; [lra|].
  pose proof (Rmin_l (d / 2) ((b - a) / 2)). pose proof (Rmin_r (d / 2) ((b - a) / 2)).
  assert (0 < Rmin (d / 2) ((b - a) / 2)) by (apply Rmin_pos; lra).
  set (c := a + Rmin (d / 2) ((b - a) / 2)).
  specialize (H c ltac:(unfold c; lra)). apply Rabs_le_between in H.
  assert (turned h 0 c < turned h 0 a) by (unfold c in *; nra).
  assert (turned h 0 b <= turned h 0 c); [|lra].
  apply Ropp_le_cancel. apply (never_falls_continuous (fun t => - turned h 0 t)); [unfold c; lra| |].
  - intros t _. apply fl_opp. exact (lc_turned h 0 t hb).
  - intros t inside. exists (- turned_rate h 0 t). split.
    + specialize (rate t ltac:(unfold c in *; lra)). lra.
    + apply rd_opp, rd_turned, hb.
Qed.

(** ** The switching curve *)

Section OnCurve.
  Variable P : R.
  Hypothesis on : reachable P.
  Let s := s_of P.
  Let m := m_of s.
  Let c := c_of s.
  Let w := w_of s.

  Lemma on_facts : 0 < s /\ s * s < 1 /\ 1 / 5 <= s * s /\ 0 < c /\ c * c = 1 - s * s /\ w * w = s * s + 3
    /\ m = 3 * s - w /\ 0 < w - 2 * s /\ 0 < 1 + m * s /\ m * m + 2 * m * s + 1 = P
    /\ sqrt (discriminant P) = 4 * (s * w) - 2 * (s * s) - 3.
  Proof.
    pose proof (s_of_reachable P on) as ps. destruct (curve_facts s ps) as (spos & below & cpos & cc & ww & mw & wpos & mP).
    destruct ps as [_ [fifth _]]. pose proof (circle_of_reachable P on) as circle.
    repeat split; try assumption.
    - unfold m. rewrite m_circle. exact circle.
    - pose proof (s_of_sq P on) as ss. unfold circle_sq in circle. fold s w in ss, circle. lra.
  Qed.

  Lemma curve_circle : curve_x P * curve_x P + (curve_y P + 1) * (curve_y P + 1) = P.
  Proof.
    destruct on_facts as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    unfold curve_x, curve_y. fold s m c. rewrite <- circle.
    replace (m * c * (m * c)) with (m * m * (c * c)) by ring. rewrite cc. ring.
  Qed.

  (** The switching point is where the margin of RL changes its sign for the second time. *)
  Lemma tangency_factor y :
    tangency P y = 8 * (curve_y P - y) * (sqrt (discriminant P) - 3 * (curve_y P - y)).
  Proof.
    destruct on_facts as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    rewrite root. unfold curve_y, tangency. fold s m. rewrite <- circle, mw.
    assert (w3 : w * w * w = w * (s * s + 3)) by (rewrite <- ww; ring).
    assert (w4 : w * w * w * w = (s * s + 3) * (s * s + 3)) by (rewrite <- ww; ring).
    match goal with |- ?a = ?b => assert (zero : a - b = 0); [|lra] end.
    ring_simplify.
    replace (w ^ 4) with ((s * s + 3) * (s * s + 3)) by (rewrite <- ww; ring).
    replace (w ^ 3) with (w * (s * s + 3)) by (rewrite <- ww; ring).
    replace (w ^ 2) with (s * s + 3) by (rewrite <- ww; ring). ring.
  Qed.

  Lemma curve_below_target : curve_y P < 1.
  Proof.
    destruct on_facts as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    unfold curve_y. fold s m. rewrite mw. assert (sw : (s * w) * (s * w) = s * s * (s * s + 3)) by (rewrite <- ww; ring).
    assert (0 <= s * w) by nra. apply Rnot_le_lt. intros le. assert (s * w <= 3 * (s * s) - 1) by lra. nra.
  Qed.

  (** The last arc and the first one balance. *)
  Lemma mn_above : 2 * (s * s) + 1 <= 2 * (s * w).
  Proof.
    destruct on_facts as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    assert (sw : (s * w) * (s * w) = s * s * (s * s + 3)) by (rewrite <- ww; ring).
    assert (0 <= s * w) by nra. apply Rnot_lt_le. intros lt. nra.
  Qed.

  Lemma arcs_above : PI < arcs s.
  Proof.
    destruct on_facts as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    pose proof mn_above as mn.
    assert (balance : - turn_to m s <= turn_to (w - s) s).
    { unfold turn_to. fold c. rewrite <- atan_opp. set (n := w - s). assert (npos : 0 < 1 + n * s) by (unfold n; nra).
      assert (le : - (m * c / (1 + m * s)) <= n * c / (1 + n * s)).
      { apply Rmult_le_reg_r with ((1 + m * s) * (1 + n * s)); [apply Rmult_lt_0_compat; lra|].
        replace (- (m * c / (1 + m * s)) * ((1 + m * s) * (1 + n * s))) with (- (m * c) * (1 + n * s)) by (field; lra).
        replace (n * c / (1 + n * s) * ((1 + m * s) * (1 + n * s))) with (n * c * (1 + m * s)) by (field; lra).
        assert (0 <= c * (2 * s * (1 + m * n))); [|unfold n in *; rewrite mw in *; nra].
        apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; [lra|]. unfold n. rewrite mw. nra. }
      destruct le as [lt|eq]; [left; apply atan_increasing, lt|rewrite eq; apply Rle_refl]. }
    assert (half : asin s < PI / 2).
    { apply Rnot_le_lt. intros le. assert (sin (PI / 2) <= sin (asin s)).
      { pose proof (asin_bound s). replace (asin s) with (PI / 2) by lra. apply Rle_refl. }
      rewrite sin_PI2, sin_asin in H by nra. nra. }
    unfold arcs. fold m w. lra.
  Qed.

  (** At the switching point RL takes the time of LRL. *)
  Lemma times_on_curve_below : time_rl_left (curve_x P) (curve_y P) + turn_to m s = arcs s.
  Proof.
    pose proof (s_of_reachable P on) as ps. destruct (curve_angles s ps) as (r4 & db & last & cb & sb).
    destruct on_facts as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    pose proof curve_below_target as low. change (m * s < 1) in low.
    destruct (lower_polar (m * c) (m * s) low) as [px py]. destruct (range_below (m * c) (m * s) low) as [_ rpos].
    change (time_rl_left (m * c) (m * s) + turn_to m s = turn_to m s + (2 * PI - 2 * asin s) + turn_to (w - s) s).
    fold m c w in r4, db, last, cb, sb. unfold time_rl_left.
    rewrite last. set (r := range (m * c) (m * s)) in *. set (d := asin (r / 4)) in *.
    pose proof PI_RGT_0. pose proof (asin_bound s).
    assert (a0 : 0 <= asin s).
    { apply Rnot_lt_le. intros neg. assert (sin (asin s) < 0) by (apply sin_lt_0_var; lra).
      rewrite sin_asin in H1 by nra. lra. }
    rewrite cos_minus, cos_PI, sin_PI in cb. rewrite sin_minus, cos_PI, sin_PI in sb.
    assert (lower_angle (m * c) (m * s) = d + 2 * asin s - PI / 2); [|lra].
    pose proof (atan_bound (m * c / (1 - m * s))). unfold lower_angle in *.
    apply same_angle; [apply Rabs_lt_between; lra| |]; apply Rmult_eq_reg_l with r; try lra.
    - rewrite py, cos_minus, cos_PI2, sin_PI2. lra.
    - rewrite px, sin_minus, cos_PI2, sin_PI2. lra.
  Qed.
End OnCurve.

(** The states below the axis for which LRL is considered: on the left, before the switching curve. *)
Definition left_below (x y : R) : Prop :=
  x < 0 /\ reachable (outer_sq x y)
  /\ outer_angle x y <= turn_to (m_of (s_of (outer_sq x y))) (s_of (outer_sq x y)).

Lemma off_cut_left x y : x < 0 -> off_cut (y + 1) x.
Proof. intros left. apply off_cut_intro. right. lra. Qed.

(** A state as a point of the circle about [(0, -1)]. *)
Lemma outer_polar x y : off_cut (y + 1) x -> let h := sqrt (outer_sq x y) in
  h * sin (outer_angle x y) = x /\ h * cos (outer_angle x y) - 1 = y /\ 0 < h.
Proof.
  intros off h. destruct (cos_sin_angle_of _ _ off) as [ec es]. pose proof (off_cut_length _ _ off) as pos.
  rewrite outer_length in ec, es, pos. fold h in ec, es, pos. fold (outer_angle x y) in ec, es. repeat split; lra.
Qed.

Lemma outer_angle_left x y : x < 0 -> - PI < outer_angle x y < 0.
Proof.
  intros left. destruct (outer_polar x y (off_cut_left x y left)) as (hs & _ & hpos).
  pose proof (angle_of_bounds (y + 1) x) as bounds. fold (outer_angle x y) in bounds. split; [lra|].
  apply Rnot_le_lt. intros nonneg. assert (0 <= sin (outer_angle x y)) by (apply sin_ge_0; lra). nra.
Qed.

Lemma curve_angle P : reachable P -> outer_angle (curve_x P) (curve_y P) = turn_to (m_of (s_of P)) (s_of P).
Proof.
  intros on. destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
  unfold curve_x, curve_y. rewrite outer_angle_above by lra. unfold turn_to. f_equal. f_equal. ring.
Qed.

Section BeforeCurve.
  Variables x y : R.
  Hypothesis lb : left_below x y.
  Let P := outer_sq x y.
  Let h := sqrt P.
  Let a := outer_angle x y.
  Let b := turn_to (m_of (s_of P)) (s_of P).

  Lemma arc_facts : 0 < h < 2 /\ h * h = P /\ h * sin a = x /\ h * cos a - 1 = y
    /\ h * sin b = curve_x P /\ h * cos b - 1 = curve_y P /\ - PI < a < 0 /\ - (PI / 2) < b < PI / 2.
  Proof.
    destruct lb as (left & on & before). fold P in on, before. destruct (outer_polar x y (off_cut_left x y left)) as (hs & hc & hpos).
    fold P h a in hs, hc, hpos. assert (hh : h * h = P) by (apply sqrt_sqrt; destruct on; lra).
    assert (h2 : h < 2) by (destruct on as [[_ lt] _]; nra).
    destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    pose proof (curve_circle P on) as onc.
    assert (offc : off_cut (curve_y P + 1) (curve_x P)) by (apply off_cut_intro; left; unfold curve_y; lra).
    destruct (outer_polar _ _ offc) as (ks & kc & _). unfold outer_sq in ks, kc. rewrite onc in ks, kc.
    rewrite (curve_angle P on) in ks, kc. fold h b in ks, kc.
    pose proof (outer_angle_left x y left) as ab. change (- PI < a < 0) in ab.
    assert (bb : - (PI / 2) < b < PI / 2).
    { pose proof (atan_bound (m_of (s_of P) * c_of (s_of P) / (1 + m_of (s_of P) * s_of P))).
      unfold b, turn_to. lra. }
    split; [split; assumption|]. split; [exact hh|]. split; [exact hs|]. split; [exact hc|].
    split; [exact ks|]. split; [exact kc|]. split; [exact ab|exact bb].
  Qed.

  Lemma first_arc_nonneg : a <= b.
  Proof. exact (proj2 (proj2 lb)). Qed.

  Lemma lrl_by_turning : time_lrl x y = turned h 0 b - a.
  Proof.
    destruct arc_facts as (hb & hh & sa & ca & sb & cb & ab & bb). destruct lb as (left & on & before). fold P in on, before.
    unfold turned. rewrite sb, cb. pose proof (times_on_curve_below P on) as tie. fold b in tie.
    unfold time_lrl. fold P a. lra.
  Qed.

  Lemma rl_by_turning : time_rl_left x y = turned h 0 a - a.
  Proof. destruct arc_facts as (hb & hh & sa & ca & _). unfold turned. rewrite sa, ca. lra. Qed.
End BeforeCurve.

(** How far a state is beyond the switching point, as an angle. *)
Lemma fl_turn_gap {F : (R -> Prop) -> Prop} {FF : Filter F} (x y : R -> R) x0 y0 :
  filterlim x F (locally x0) -> filterlim y F (locally y0) -> off_cut (y0 + 1) x0 -> reachable (outer_sq x0 y0) ->
  filterlim (fun s => outer_angle (x s) (y s) - turn_to (m_of (s_of (outer_sq (x s) (y s)))) (s_of (outer_sq (x s) (y s)))) F
    (locally (outer_angle x0 y0 - turn_to (m_of (s_of (outer_sq x0 y0))) (s_of (outer_sq x0 y0)))).
Proof.
  intros lx ly off on. pose proof (fl_s_of _ _ on (fl_outer_sq x y x0 y0 lx ly)) as ls.
  pose proof (s_of_reachable _ on) as ps. pose proof (proper_inside _ ps) as inside. pose proof (m_above _ ps) as above.
  assert (lm : filterlim (fun s => m_of (s_of (outer_sq (x s) (y s)))) F (locally (m_of (s_of (outer_sq x0 y0))))).
  { unfold m_of. apply fl_minus; [apply fl_scal, ls|]. exact (fl_derive w_of _ _ _ (is_derive_w _) ls). }
  pose proof (fl_derive c_of _ _ _ (is_derive_c _ inside) ls) as lc.
  apply fl_minus; [apply fl_outer_angle; assumption|]. unfold turn_to.
  apply (fl_comp atan); [apply (ex_derive_continuous atan); eexists; apply is_derive_atan|].
  apply fl_mult; [apply fl_mult; assumption|]. apply fl_inv; [lra|]. apply fl_plus; [apply fl_const|].
  apply fl_mult; assumption.
Qed.
