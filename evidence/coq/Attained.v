(** Each maneuver of the synthesis is a trajectory, and takes the least time. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound.
Open Scope R_scope.

(** Some trajectory of duration [T] leads from [(x0, y0)] to [(x1, y1)]; [th] is the heading, from that at first. *)
Definition reaches (x0 y0 T x1 y1 : R) : Prop :=
  exists x y th u, trajectory x y u T /\ turns th u T /\ x 0 = x0 /\ y 0 = y0 /\ x T = x1 /\ y T = y1.

(** Smooth motion under a constant control is a trajectory. *)
Lemma constant_control (x y : R -> R) u T : 0 <= T -> -1 <= u <= 1 ->
  (forall t, is_derive x t (1 + u * y t)) -> (forall t, is_derive y t (- (u * x t))) ->
  trajectory x y (fun _ => u) T.
Proof.
  intros T0 ub dx dy. constructor; intros; try assumption.
  - exact (lc_of_derive _ _ _ (dx t)).
  - exact (lc_of_derive _ _ _ (dy t)).
  - exact (rd_of_derive _ _ _ (dx t)).
  - exact (rd_of_derive _ _ _ (dy t)).
Qed.

Lemma constant_turn u T : turns (fun t => u * t) (fun _ => u) T.
Proof.
  split; [|split; intros t _]; [ring| |].
  - apply fl_scal, lc_id.
  - pose proof (rd_scal u _ _ _ (rd_id t)) as rd. rewrite Rmult_1_r in rd. exact rd.
Qed.

Lemma flies_right r a b : a <= b ->
  reaches (r * cos a) (1 + r * sin a) (b - a) (r * cos b) (1 + r * sin b).
Proof.
  intros ab. exists (fun t => r * cos (a + t)), (fun t => 1 + r * sin (a + t)), (fun t => -1 * t), (fun _ => -1).
  rewrite Rplus_0_r. replace (a + (b - a)) with b by ring. split; [|split; [apply constant_turn|repeat split; ring]].
  apply constant_control; [lra|lra| |]; intros v; auto_derive; try exact I; ring.
Qed.

Lemma flies_left r a b : a <= b ->
  reaches (r * sin a) (r * cos a - 1) (b - a) (r * sin b) (r * cos b - 1).
Proof.
  intros ab. exists (fun t => r * sin (a + t)), (fun t => r * cos (a + t) - 1), (fun t => 1 * t), (fun _ => 1).
  rewrite Rplus_0_r. replace (a + (b - a)) with b by ring. split; [|split; [apply constant_turn|repeat split; ring]].
  apply constant_control; [lra|lra| |]; intros v; auto_derive; try exact I; ring.
Qed.

Lemma flies_straight a b : a <= b -> reaches a 0 (b - a) b 0.
Proof.
  intros ab. exists (fun t => a + t), (fun _ => 0), (fun t => 0 * t), (fun _ => 0).
  replace (a + (b - a)) with b by ring. rewrite Rplus_0_r. split; [|split; [apply constant_turn|repeat split; ring]].
  apply constant_control; [lra|lra| |]; intros v; auto_derive; try exact I; ring.
Qed.

(** ** One trajectory after another *)

Definition joined (f g : R -> R) (T t : R) : R := if Rlt_dec t T then f t else g (t - T).

Lemma joined_before f g T t : t < T -> joined f g T t = f t.
Proof. intros lt. unfold joined. destruct (Rlt_dec t T); [reflexivity|contradiction]. Qed.

Lemma joined_after f g T t : T <= t -> joined f g T t = g (t - T).
Proof. intros le. unfold joined. destruct (Rlt_dec t T); [lra|reflexivity]. Qed.

Lemma joined_rd_before f g T t l : t < T -> right_derive f t l -> right_derive (joined f g T) t l.
Proof.
  intros lt rf eps pos. destruct (rf eps pos) as [d [dpos H]].
  pose proof (Rmin_l d (T - t)). pose proof (Rmin_r d (T - t)). exists (Rmin d (T - t)).
  split; [apply Rmin_pos; lra|]. intros s near. rewrite !joined_before by lra. apply H. lra.
Qed.

Lemma joined_rd_after f g T t l : T <= t -> right_derive g (t - T) l -> right_derive (joined f g T) t l.
Proof.
  intros le rg eps pos. destruct (rg eps pos) as [d [dpos H]]. exists d. split; [exact dpos|]. intros s near.
  rewrite !joined_after by lra. specialize (H (s - T) ltac:(lra)).
  replace (s - T - (t - T)) with (s - t) in H by ring. exact H.
Qed.

Lemma joined_lc f g T t : f T = g 0 -> (t <= T -> left_continuous f t) -> (T < t -> left_continuous g (t - T)) ->
  left_continuous (joined f g T) t.
Proof.
  intros meet lf lg. apply epsilon_lc. intros eps pos.
  destruct (Rle_dec t T) as [le|gt].
  - destruct (lc_epsilon f t (lf le) eps pos) as [d [dpos H]]. exists d. split; [exact dpos|]. intros s near.
    rewrite joined_before by lra. replace (joined f g T t) with (f t); [apply H, near|].
    destruct le as [lt| ->]; [symmetry; apply joined_before, lt|]. rewrite joined_after by lra.
    rewrite Rminus_eq_0. exact meet.
  - destruct (lc_epsilon g (t - T) (lg ltac:(lra)) eps pos) as [d [dpos H]].
    pose proof (Rmin_l d (t - T)). pose proof (Rmin_r d (t - T)). exists (Rmin d (t - T)).
    split; [apply Rmin_pos; lra|]. intros s near. rewrite !joined_after by lra. apply H. lra.
Qed.

Lemma reaches_trans x0 y0 T1 x1 y1 T2 x2 y2 :
  reaches x0 y0 T1 x1 y1 -> reaches x1 y1 T2 x2 y2 -> reaches x0 y0 (T1 + T2) x2 y2.
Proof.
  intros (x & y & th & u & [d1 c1 lx1 ly1 mx1 my1] & (h1 & lh1 & mh1) & ex0 & ey0 & ex1 & ey1)
    (x' & y' & th' & u' & [d2 c2 lx2 ly2 mx2 my2] & (h2 & lh2 & mh2) & fx0 & fy0 & fx1 & fy1).
  exists (joined x x' T1), (joined y y' T1), (joined th (fun t => th T1 + th' t) T1), (joined u u' T1).
  split; [constructor|split; [split; [|split]|]].
  - lra.
  - intros t inside. destruct (Rlt_dec t T1) as [lt|ge].
    + rewrite joined_before by exact lt. apply c1. lra.
    + rewrite joined_after by lra. apply c2. lra.
  - intros t inside. apply joined_lc; [lra|intros; apply lx1; lra|intros; apply lx2; lra].
  - intros t inside. apply joined_lc; [lra|intros; apply ly1; lra|intros; apply ly2; lra].
  - intros t inside. destruct (Rlt_dec t T1) as [lt|ge].
    + rewrite !joined_before by exact lt. apply joined_rd_before; [exact lt|]. apply mx1. lra.
    + rewrite !joined_after by lra. apply joined_rd_after; [lra|]. apply mx2. lra.
  - intros t inside. destruct (Rlt_dec t T1) as [lt|ge].
    + rewrite !joined_before by exact lt. apply joined_rd_before; [exact lt|]. apply my1. lra.
    + rewrite !joined_after by lra. apply joined_rd_after; [lra|]. apply my2. lra.
  - destruct (Rlt_dec 0 T1) as [lt|ge]; [rewrite joined_before by exact lt; exact h1|].
    assert (T1 = 0) by lra. subst T1. rewrite joined_after by lra. rewrite Rminus_0_r. lra.
  - intros t inside. apply joined_lc; [lra|intros; apply lh1; lra|].
    intros. apply fl_plus; [apply fl_const|apply lh2; lra].
  - intros t inside. destruct (Rlt_dec t T1) as [lt|ge].
    + rewrite joined_before by exact lt. apply joined_rd_before; [exact lt|]. apply mh1. lra.
    + rewrite joined_after by lra. apply joined_rd_after; [lra|].
      replace (u' (t - T1)) with (0 + u' (t - T1)) by ring. apply rd_plus; [apply rd_const|apply mh2; lra].
  - assert (start : joined x x' T1 0 = x0 /\ joined y y' T1 0 = y0).
    { destruct (Rlt_dec 0 T1) as [lt|ge].
      - rewrite !joined_before by exact lt. split; assumption.
      - assert (T1 = 0) by lra. subst T1. rewrite !joined_after by lra. rewrite Rminus_0_r. split; congruence. }
    rewrite !(joined_after _ _ _ (T1 + T2)) by lra. replace (T1 + T2 - T1) with T2 by ring. tauto.
Qed.

Lemma reaches_same x0 y0 T x1 y1 x0' y0' T' x1' y1' : reaches x0 y0 T x1 y1 ->
  x0 = x0' -> y0 = y0' -> T = T' -> x1 = x1' -> y1 = y1' -> reaches x0' y0' T' x1' y1'.
Proof. intros; subst; assumption. Qed.

(** ** The maneuvers *)

Lemma stays_at_target : reaches 0 1 0 0 1.
Proof.
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (flies_right 0 0 0 (Rle_refl 0))); ring.
Qed.

Lemma right_from x y d : off_axis x y -> PI / 3 + bearing x y <= PI + d ->
  reaches x y (PI + d - (PI / 3 + bearing x y)) (- (range x y * cos d)) (1 - range x y * sin d).
Proof.
  intros off le. destruct (polar x y off) as [px py].
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (flies_right (range x y) _ _ le)).
  - exact px.
  - lra.
  - reflexivity.
  - rewrite (Rplus_comm PI), neg_cos. ring.
  - rewrite (Rplus_comm PI), neg_sin. ring.
Qed.

Lemma rl_flown x y : off_axis x y -> range_sq x y <= 16 -> PI / 3 + bearing x y <= PI + asin (range x y / 4) ->
  reaches x y (time_rl x y) 0 1.
Proof.
  intros off near le. destruct (asin_quarter x y near) as [sd db]. set (d := asin (range x y / 4)) in *.
  pose proof (right_from x y d off le) as first. pose proof (flies_left 2 (- (2 * d)) 0 ltac:(lra)) as last.
  assert (r : range x y = 4 * sin d) by lra.
  replace (2 * sin (- (2 * d))) with (- (range x y * cos d)) in last by (rewrite sin_neg, sin_2a, r; ring).
  replace (2 * cos (- (2 * d)) - 1) with (1 - range x y * sin d) in last by (rewrite cos_neg, cos_2a_sin, r; ring).
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ first last)).
  - reflexivity.
  - reflexivity.
  - unfold time_rl. fold d. lra.
  - rewrite sin_0. ring.
  - rewrite cos_0. ring.
Qed.

Lemma last_arc_flown : reaches (- sqrt 3) 0 (PI / 3) 0 1.
Proof.
  pose proof PI_RGT_0. apply (reaches_same _ _ _ _ _ _ _ _ _ _ (flies_left 2 (- (PI / 3)) 0 ltac:(lra))).
  - rewrite sin_neg, sin_PI3. field.
  - rewrite cos_neg, cos_PI3. field.
  - ring.
  - rewrite sin_0. ring.
  - rewrite cos_0. ring.
Qed.

(** RSL without its last arc. *)
Lemma to_axis_flown x y : 0 <= y -> 4 <= range_sq x y -> reaches x y (time_rsl x y - PI / 3) (- sqrt 3) 0.
Proof.
  intros up far. pose proof (off_axis_far x y up far) as off. set (c := sqrt (range_sq x y - 1)).
  assert (cc : c * c = range_sq x y - 1) by (apply sqrt_sqrt; lra).
  assert (c3 : sqrt 3 <= c) by (apply sqrt_le_1_alt; lra).
  assert (cpos : 0 < c) by (pose proof sqrt3_bounds; lra).
  pose proof (range_range x y) as rr. pose proof (off_axis_range x y off) as rpos. set (r := range x y) in *.
  set (d := atan (/ c)). pose proof PI_RGT_0.
  assert (root : sqrt (1 + / c * / c) = r / c).
  { apply sqrt_lem_1; [|left; apply Rdiv_lt_0_compat; lra|].
    - pose proof (pow2_ge_0 (/ c)). lra.
    - replace (r / c * (r / c)) with (r * r / (c * c)) by (field; lra). rewrite rr.
      replace (range_sq x y) with (c * c + 1) by lra. field. lra. }
  assert (cd : r * cos d = c).
  { unfold d. rewrite cos_atan. unfold Rsqr. rewrite root. field. lra. }
  assert (sd : r * sin d = 1).
  { unfold d. rewrite sin_atan. unfold Rsqr. rewrite root. field. lra. }
  assert (db : 0 <= d <= PI / 2).
  { pose proof (atan_bound (/ c)) as bound. fold d in bound. split; [|lra]. unfold d. rewrite <- atan_0. left.
    apply atan_increasing, Rinv_0_lt_compat, cpos. }
  assert (le : PI / 3 + bearing x y <= PI + d) by (apply rotation_nonneg; [exact off|exact db|fold r; lra]).
  pose proof (right_from x y d off le) as first. fold r in first. rewrite cd, sd in first.
  replace (1 - 1) with 0 in first by ring.
  pose proof (flies_straight (- c) (- sqrt 3) ltac:(lra)) as middle.
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ first middle)); try reflexivity.
  unfold time_rsl. fold c d. lra.
Qed.

Lemma rsl_flown x y : 0 <= y -> 4 <= range_sq x y -> reaches x y (time_rsl x y) 0 1.
Proof.
  intros up far.
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ (to_axis_flown x y up far) last_arc_flown));
    try reflexivity. ring.
Qed.

Lemma lrl_flown x y : 0 <= y -> left_first x y -> reaches x y (time_lrl x y) 0 1.
Proof.
  intros up [inside before].
  destruct (facts x y up inside) as (spos & mpos & cpos & cc & ww & mw & wpos & mP).
  pose proof (curve_on_circle x y up inside) as circle. pose proof (P_bounds x y up inside) as Pb.
  set (P := outer_sq x y) in *. set (a := curve_x P). set (b := curve_y P).
  assert (b0 : 0 <= b) by (unfold b, curve_y; nra). assert (a0 : 0 <= a) by (unfold a, curve_x; nra).
  assert (same : outer_sq a b = P) by (unfold outer_sq, a, b, curve_x, curve_y; exact circle).
  assert (inside' : outer_sq a b < 4) by (rewrite same; exact inside).
  assert (off : off_axis a b) by (apply off_axis_curve; [exact b0|exact inside'|rewrite same; apply Rle_refl]).
  assert (on : time_lrl a b = time_rl a b) by (apply times_on_curve; [exact b0|exact inside'|rewrite same; reflexivity]).
  assert (near : range_sq a b <= 16) by (rewrite outer_range in inside'; lra).
  assert (le : PI / 3 + bearing a b <= PI + asin (range a b / 4)).
  { pose proof (angle_right a b off a0). destruct (asin_quarter a b near) as [_ db]. pose proof PI_RGT_0. lra. }
  pose proof (rl_flown a b off near le) as rest. rewrite <- on in rest.
  (* the first arc *)
  set (h := sqrt P). assert (hpos : 0 < h) by (apply sqrt_lt_R0; lra). assert (hh : h * h = P) by (apply sqrt_sqrt; lra).
  assert (place : forall p q, 0 <= q -> outer_sq p q = P ->
      h * sin (outer_angle p q) = p /\ h * cos (outer_angle p q) - 1 = q).
  { intros p q q0 onP. rewrite outer_angle_above by lra. rewrite sin_atan, cos_atan. unfold Rsqr.
    assert (root : sqrt (1 + p / (q + 1) * (p / (q + 1))) = h / (q + 1)).
    { apply sqrt_lem_1; [|left; apply Rdiv_lt_0_compat; lra|].
      - pose proof (pow2_ge_0 (p / (q + 1))). lra.
      - replace (h / (q + 1) * (h / (q + 1))) with (h * h / ((q + 1) * (q + 1))) by (field; lra).
        rewrite hh, <- onP. unfold outer_sq. field. lra. }
    rewrite root. split; field; lra. }
  destruct (place x y up eq_refl) as [sx cx]. destruct (place a b b0 same) as [sa ca].
  assert (earlier : outer_angle x y <= outer_angle a b).
  { rewrite !outer_angle_above by lra. assert (x / (y + 1) <= a / (b + 1)).
    { destruct (Rle_dec x 0) as [left|right].
      - apply Rle_trans with 0.
        + unfold Rdiv. assert (0 < / (y + 1)) by (apply Rinv_0_lt_compat; lra). nra.
        + apply Rmult_le_pos; [exact a0|left; apply Rinv_0_lt_compat; lra].
      - assert (b <= y).
        { apply (lower_to_the_right x y a b); [lra|exact before|lra|lra|rewrite same; reflexivity]. }
        unfold Rdiv. apply Rmult_le_compat; [lra|left; apply Rinv_0_lt_compat; lra|exact before|].
        apply Rinv_le_contravar; lra. }
    destruct H as [lt|<-]; [left; apply atan_increasing, lt|apply Rle_refl]. }
  pose proof (flies_left h _ _ earlier) as first. rewrite sx, cx, sa, ca in first.
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ first rest)); try reflexivity.
  unfold time_lrl. rewrite same. fold P. ring.
Qed.

Theorem attained_up x y : 0 <= y -> reaches x y (least_time_up x y) 0 1.
Proof.
  intros up. unfold least_time_up. destruct (Req_EM_T _ _) as [zero|other].
  { destruct (at_target _ _ zero) as [-> ->]. exact stays_at_target. }
  destruct (Rle_dec 4 _) as [far|near]; [apply rsl_flown; assumption|].
  destruct (left_first_dec x y) as [lf|right]; [apply lrl_flown; assumption|].
  assert (q16 : range_sq x y <= 16) by lra. destruct (asin_quarter x y q16) as [sd db].
  destruct (Rlt_dec (outer_sq x y) 4) as [inside|beyond].
  - assert (after : curve_x (outer_sq x y) <= x).
    { apply Rnot_lt_le. intros lt. apply right. split; [exact inside|left; exact lt]. }
    pose proof (off_axis_curve x y up inside after) as off.
    apply rl_flown; [exact off|exact q16|].
    assert (x0 : 0 <= x) by (eapply Rle_trans; [apply curve_x_nonneg, (P_bounds x y up inside)|exact after]).
    pose proof (angle_right x y off x0). pose proof PI_RGT_0. lra.
  - pose proof (off_axis_outside x y up other ltac:(lra) ltac:(lra)) as off.
    apply rl_flown; [exact off|exact q16|]. apply rotation_nonneg; [exact off|exact db|]. rewrite sd.
    pose proof (range_range x y). rewrite outer_range in beyond. nra.
Qed.
