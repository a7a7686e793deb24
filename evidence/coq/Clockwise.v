(** The fastest entry of a Dubins vehicle onto the circle of its turn radius in one prescribed direction, clockwise, from
    every position and heading. *)

Require Import Reals Lra Classical.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound Attained Synthesis.
From Loiter Require Import Below BelowCurve BelowBound.
Open Scope R_scope.

Lemma lc_close_at f t v : filterlim f (at_left t) (locally v) -> forall eps, 0 < eps -> at_left t (fun s => f s <= v + eps).
Proof.
  intros lf eps pos. apply (filter_imp (fun s => f s < v + eps)); [intros; lra|]. apply (fl_below f v); [lra|exact lf].
Qed.

Lemma atan_nonneg v : 0 <= v -> 0 <= atan v.
Proof. intros nonneg. rewrite <- atan_0. destruct nonneg as [lt|<-]; [left; apply atan_increasing, lt|apply Rle_refl]. Qed.

(** On the circle of radius [rho] about the origin, along its tangent, clockwise. *)
Definition on_clockwise_circle (rho X Y th : R) : Prop := X = - (rho * sin th) /\ Y = rho * cos th.

(** The least time to [(0, 1)] from any reduced state. *)
Definition least_time_clockwise (x y : R) : R :=
  if Rle_dec 0 y then least_time_up x y
  else if Rle_dec 4 (outer_sq x y) then least_time_up x (- y)
  else least_time_below x y.

(** * Every maneuver is flown *)

Lemma right_from_below x y b : y < 1 -> lower_angle x y - PI / 2 <= b ->
  reaches x y (b - (lower_angle x y - PI / 2)) (range x y * cos b) (1 + range x y * sin b).
Proof.
  intros low le. destruct (lower_polar x y low) as [px py].
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (flies_right (range x y) _ _ le)); try reflexivity.
  - rewrite cos_minus, cos_PI2, sin_PI2. lra.
  - rewrite sin_minus, cos_PI2, sin_PI2. lra.
Qed.

Lemma rl_left_flown x y : y < 1 -> range_sq x y <= 16 -> reaches x y (time_rl_left x y) 0 1.
Proof.
  intros low near. destruct (asin_quarter x y near) as [sd db]. unfold time_rl_left. set (d := asin (range x y / 4)) in *.
  pose proof (atan_bound (x / (1 - y))) as lb. fold (lower_angle x y) in lb. pose proof PI_RGT_0.
  pose proof (right_from_below x y (PI + d) low ltac:(lra)) as first. pose proof (flies_left 2 (- (2 * d)) 0 ltac:(lra)) as last.
  assert (r : range x y = 4 * sin d) by lra.
  replace (2 * sin (- (2 * d))) with (range x y * cos (PI + d)) in last
    by (rewrite sin_neg, sin_2a, r, (Rplus_comm PI), neg_cos; ring).
  replace (2 * cos (- (2 * d)) - 1) with (1 + range x y * sin (PI + d)) in last
    by (rewrite cos_neg, cos_2a_sin, r, (Rplus_comm PI), neg_sin; ring).
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ first last)); try reflexivity.
  - lra.
  - rewrite sin_0. ring.
  - rewrite cos_0. ring.
Qed.

(** Within the last circle the state is not beyond the right crossing. *)
Lemma before_right_crossing x y : y <= 0 -> outer_sq x y <= 4 -> range_sq x y <= 16 ->
  lower_angle x y + asin (range x y / 4) <= PI / 2.
Proof.
  intros down within near. destruct (asin_quarter x y near) as [sd db]. set (d := asin (range x y / 4)) in *.
  destruct (lower_polar x y ltac:(lra)) as [_ py]. destruct (range_below x y ltac:(lra)) as [_ rpos].
  pose proof (atan_bound (x / (1 - y))) as lb. fold (lower_angle x y) in lb. pose proof PI_RGT_0.
  pose proof (range_range x y) as rr. rewrite outer_range in within.
  apply Rnot_lt_le. intros beyond.
  assert (lower : cos (lower_angle x y) < cos (PI / 2 - d)) by (apply cos_decreasing_1; lra).
  rewrite cos_shift, sd in lower.
  pose proof (scaled_lt _ _ _ rpos lower) as scaled. rewrite py in scaled.
  replace (range x y * (range x y / 4)) with (range_sq x y / 4) in scaled by (rewrite <- rr; field). lra.
Qed.

Lemma rl_right_flown x y : y <= 0 -> outer_sq x y <= 4 -> range_sq x y <= 16 -> reaches x y (time_rl_right x y) 0 1.
Proof.
  intros down within near. pose proof (before_right_crossing x y down within near) as le.
  destruct (asin_quarter x y near) as [sd db]. unfold time_rl_right. set (d := asin (range x y / 4)) in *.
  pose proof PI_RGT_0.
  pose proof (right_from_below x y (- d) ltac:(lra) ltac:(lra)) as first. pose proof (flies_left 2 (2 * d) (2 * PI) ltac:(lra)) as last.
  assert (r : range x y = 4 * sin d) by lra.
  replace (2 * sin (2 * d)) with (range x y * cos (- d)) in last by (rewrite cos_neg, sin_2a, r; ring).
  replace (2 * cos (2 * d) - 1) with (1 + range x y * sin (- d)) in last by (rewrite sin_neg, cos_2a_sin, r; ring).
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ first last)); try reflexivity.
  - lra.
  - rewrite sin_2PI. ring.
  - rewrite cos_2PI. ring.
Qed.

Lemma lrl_flown_below x y : y <= 0 -> left_below x y -> reaches x y (time_lrl x y) 0 1.
Proof.
  intros down lb. destruct (arc_facts x y lb) as (hb & hh & sa & ca & sb & cb & ab & bb).
  pose proof (first_arc_nonneg x y lb) as le. pose proof (flies_left (sqrt (outer_sq x y)) _ _ le) as first.
  pose proof (lrl_by_turning x y lb) as time. destruct lb as (left & on & before).
  set (P := outer_sq x y) in *. set (h := sqrt P) in *. set (b := turn_to (m_of (s_of P)) (s_of P)) in *.
  unfold turned in time. rewrite sa, ca in first. rewrite sb, cb in first, time.
  destruct (arc_range h b hb) as [_ nr]. rewrite sb, cb in nr.
  pose proof (rl_left_flown (curve_x P) (curve_y P) (curve_below_target P on) (Rlt_le _ _ nr)) as rest.
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _ first rest)); try reflexivity.
  rewrite time. ring.
Qed.

Lemma attained_below x y : y < 0 -> outer_sq x y < 4 -> reaches x y (least_time_below x y) 0 1.
Proof.
  intros down within. pose proof (range_within x y down within) as near.
  destruct (below_is x y) as [->|[->|[lb ->]]].
  - apply rl_left_flown; lra.
  - apply rl_right_flown; lra.
  - apply lrl_flown_below; [lra|exact lb].
Qed.

(** From beyond the last circle the axis is reached at [- sqrt 3], and from there either last arc is flown. *)
Lemma lsl_flown x y : y <= 0 -> 4 <= outer_sq x y -> reaches x y (least_time_up x (- y)) 0 1.
Proof.
  intros down far. assert (far' : 4 <= range_sq x (- y)) by (unfold range_sq, outer_sq in *; lra).
  assert (value : least_time_up x (- y) = time_rsl x (- y)).
  { unfold least_time_up. destruct (Req_EM_T _ _) as [zero|_]; [lra|]. destruct (Rle_dec 4 _); [reflexivity|contradiction]. }
  rewrite value. pose proof (mirrored _ _ _ _ _ (to_axis_flown x (- y) ltac:(lra) far')) as first.
  pose proof last_arc_flown as last.
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ (reaches_trans _ _ _ _ _ _ _ _
    (reaches_same _ _ _ _ _ _ y _ (- sqrt 3) 0 first eq_refl (Ropp_involutive y) eq_refl eq_refl Ropp_0) last)); try reflexivity.
  ring.
Qed.

Theorem attained_clockwise x y : reaches x y (least_time_clockwise x y) 0 1.
Proof.
  unfold least_time_clockwise. destruct (Rle_dec 0 y) as [up|down]; [exact (attained_up x y up)|].
  destruct (Rle_dec 4 _) as [far|within]; [apply lsl_flown; lra|apply attained_below; lra].
Qed.

(** * No trajectory is faster *)

(** The rest of a trajectory. *)
Lemma rest_of x y u T a : trajectory x y u T -> 0 <= a <= T ->
  trajectory (fun t => x (a + t)) (fun t => y (a + t)) (fun t => u (a + t)) (T - a).
Proof.
  intros [T0 ub lx ly mx my] inside.
  assert (lc : forall f t, left_continuous f (a + t) -> left_continuous (fun s => f (a + s)) t).
  { intros f t lf. apply epsilon_lc. intros eps pos. destruct (lc_epsilon _ _ lf eps pos) as [d [dpos H]].
    exists d. split; [exact dpos|]. intros s near. apply H. lra. }
  assert (rd : forall f t l, right_derive f (a + t) l -> right_derive (fun s => f (a + s)) t l).
  { intros f t l rf eps pos. destruct (rf eps pos) as [d [dpos H]]. exists d. split; [exact dpos|]. intros s near.
    specialize (H (a + s) ltac:(lra)). replace (a + s - (a + t)) with (s - t) in H by ring. exact H. }
  constructor.
  - lra.
  - intros t bt. apply ub. lra.
  - intros t bt. apply lc, lx. lra.
  - intros t bt. apply lc, ly. lra.
  - intros t bt. apply rd, mx. lra.
  - intros t bt. apply rd, my. lra.
Qed.

(** From any state, in either direction. *)
Lemma not_sooner_either x y u T : trajectory x y u T -> x T = 0 -> Rabs (y T) = 1 -> least_time (x 0) (y 0) <= T.
Proof.
  intros tr tx ty. destruct (reflected _ _ _ _ tr) as [v tr']. unfold least_time.
  exact (not_sooner_up x (fun t => Rabs (y t)) v T tr' (fun t => Rabs_pos (y t)) tx ty).
Qed.

(** ** Where a trajectory leaves the states within the last circle, below the axis *)

(** On the right of the axis RL with the left crossing is RL. *)
Lemma time_rl_on_the_right x y : 0 <= x -> y < 1 -> time_rl x y = time_rl_left x y.
Proof.
  intros right low. pose proof (off_axis_right x y right ltac:(right; lra)) as off.
  destruct (polar x y off) as [px py]. destruct (lower_polar x y low) as [qx qy]. destruct (range_below x y low) as [_ rpos].
  pose proof (angle_right x y off right). pose proof (atan_bound (x / (1 - y))) as lb. fold (lower_angle x y) in lb.
  pose proof PI_RGT_0. unfold time_rl, time_rl_left.
  assert (PI / 3 + bearing x y = lower_angle x y - PI / 2); [|lra].
  apply same_angle; [apply Rabs_lt_between; lra| |]; apply Rmult_eq_reg_l with (range x y); try lra.
  - rewrite px, cos_minus, cos_PI2, sin_PI2. lra.
  - rewrite py, sin_minus, cos_PI2, sin_PI2. lra.
Qed.

(** On the last circle, on the right, RL with the right crossing is the last arc alone, and that is LSL. *)
Lemma rl_right_on_last_circle x y : y <= 0 -> 0 <= x -> outer_sq x y = 4 -> time_rl_right x y = time_rsl x (- y).
Proof.
  intros down right on. assert (q4 : range_sq x (- y) = 4) by (unfold range_sq, outer_sq in *; lra).
  assert (off : off_axis x (- y)).
  { apply off_axis_far; lra. }
  destruct (polar x (- y) off) as [px py]. pose proof (angle_right x (- y) off right) as ab. pose proof PI_RGT_0.
  rewrite (times_at_two _ _ q4). unfold time_rl.
  assert (r2 : range x (- y) = 2) by (unfold range; rewrite q4; replace 4 with (2 * 2) by ring; apply sqrt_square; lra).
  rewrite r2 in *. replace (2 / 4) with (sin (PI / 6)) by (rewrite sin_PI6; field). rewrite asin_sin by lra.
  set (phi := PI / 3 + bearing x (- y) + PI / 2).
  assert (hx : x = 2 * sin phi) by (unfold phi; rewrite sin_plus, cos_PI2, sin_PI2; lra).
  assert (hy : y = 2 * cos phi - 1) by (unfold phi; rewrite cos_plus, cos_PI2, sin_PI2; lra).
  set (g := phi / 2). assert (gb : 0 <= g <= PI / 2) by (unfold g, phi; lra).
  assert (two : phi = 2 * g) by (unfold g; field). rewrite two in hx, hy.
  assert (sg : 0 <= sin g) by (apply sin_ge_0; lra).
  assert (r : range x y = 4 * sin g).
  { unfold range. apply sqrt_lem_1; [apply range_sq_nonneg|lra|]. unfold range_sq. rewrite hx, hy, sin_2a, cos_2a_sin.
    pose proof (sin2_cos2 g) as one. unfold Rsqr in one.
    replace (2 * (2 * sin g * cos g) * (2 * (2 * sin g * cos g))) with (16 * (sin g * sin g) * (cos g * cos g)) by ring.
    replace (cos g * cos g) with (1 - sin g * sin g) by lra. ring. }
  destruct (lower_polar x y ltac:(lra)) as [qx qy]. destruct (range_below x y ltac:(lra)) as [_ rpos].
  pose proof (atan_bound (x / (1 - y))) as lb. fold (lower_angle x y) in lb.
  assert (angle : lower_angle x y = PI / 2 - g).
  { apply same_angle; [apply Rabs_lt_between; lra| |]; apply Rmult_eq_reg_l with (range x y); try lra.
    - rewrite qy, cos_shift, r, hy, cos_2a_sin. ring.
    - rewrite qx, sin_shift, r, hx, sin_2a. ring. }
  unfold time_rl_right. rewrite angle, r. replace (4 * sin g / 4) with (sin g) by field. rewrite asin_sin by lra.
  unfold g, phi. lra.
Qed.

Section Leaving.
  Variables x y u : R -> R.
  Variable tau t : R.
  Hypothesis tr : trajectory x y u tau.
  Hypothesis inside : 0 < t <= tau.
  Hypothesis before : forall s, 0 <= s < t -> y s < 0 /\ outer_sq (x s) (y s) < 4.

  Let lx := left_x x y u tau tr t inside.
  Let ly := left_y x y u tau tr t inside.
  Let V s := least_time_below (x s) (y s).

  Lemma before_here : at_left t (fun s => 0 <= s < t).
  Proof.
    exists (mkposreal t (proj1 inside)). intros s n b. change (Rabs (s - t) < t) in n. apply Rabs_lt_between in n. lra.
  Qed.

  (** On the last circle it leaves on the right. *)
  Lemma leaves_right : outer_sq (x t) (y t) = 4 -> 0 <= x t.
  Proof.
    intros on. apply Rnot_lt_le. intros left.
    destruct (filter_and _ _ before_here (outer_before x y u tau tr t inside left)) as [[d dpos] H].
    pose proof (Rmin_l d t). pose proof (Rmin_r d t). assert (0 < Rmin d t) by (apply Rmin_pos; lra).
    destruct (H (t - Rmin d t / 2)) as [b fall]; [change (Rabs (t - Rmin d t / 2 - t) < d); apply Rabs_lt_between; lra|lra|].
    destruct (before _ b). lra.
  Qed.

  Lemma leaves_last_circle eps : y t <= 0 -> outer_sq (x t) (y t) = 4 -> 0 < eps ->
    at_left t (fun s => V s <= time_rl_right (x t) (y t) + eps).
  Proof.
    intros down on epos. pose proof (leaves_right on) as right. pose proof PI_RGT_0.
    assert (le : forall s, V s <= time_rl_right (x s) (y s)) by (intros s; apply below_le_right).
    destruct (Rlt_dec (range_sq (x t) (y t)) 16) as [near|far].
    { generalize (lc_close (fun s => time_rl_right (x s) (y s)) t (fl_time_rl_right x y _ _ lx ly ltac:(lra) near) eps epos).
      apply filter_imp. intros s h. specialize (le s). lra. }
    (* at the lowest point the arcsine is at its end *)
    assert (q16 : range_sq (x t) (y t) = 16) by (rewrite outer_range in on; unfold range_sq, outer_sq in *; nra).
    set (e := Rmin (eps / 6) 1). assert (e0 : 0 < e) by (apply Rmin_pos; lra).
    assert (e1 : e <= eps / 6) by apply Rmin_l. assert (e2 : e <= 1) by apply Rmin_r. pose proof PI2_1.
    assert (r4 : range (x t) (y t) = 4) by (unfold range; rewrite q16; replace 16 with (4 * 4) by ring; apply sqrt_square; lra).
    assert (value : asin (range (x t) (y t) / 4) = PI / 2) by (rewrite r4; replace (4 / 4) with 1 by field; apply asin_1).
    assert (short : sin (PI / 2 - e) < 1) by (rewrite <- sin_PI2; apply sin_increasing_1; lra).
    assert (lr : filterlim (fun s => range (x s) (y s) / 4) (at_left t) (locally (range (x t) (y t) / 4))).
    { apply fl_mult; [|apply fl_const]. unfold range. apply fl_sqrt; [apply range_sq_nonneg|].
      exact (fl_range_sq x y _ _ lx ly). }
    rewrite r4 in lr. replace (4 / 4) with 1 in lr by field.
    generalize (filter_and _ _ before_here (filter_and _ _ (fl_above _ 1 _ short lr)
      (lc_close (fun s => - lower_angle (x s) (y s)) t (fl_opp _ _ (fl_lower_angle x y _ _ lx ly ltac:(lra))) (eps / 2) ltac:(lra)))).
    apply filter_imp. intros s (b & long & angle). destruct (before s b) as [ds ws]. pose proof (range_within _ _ ds ws) as near.
    specialize (le s). unfold time_rl_right in *. rewrite value.
    pose proof (range_range (x s) (y s)) as rr. assert (r0 : 0 <= range (x s) (y s)) by apply sqrt_pos.
    assert (r1 : range (x s) (y s) / 4 <= 1) by nra.
    assert (sa : sin (asin (range (x s) (y s) / 4)) = range (x s) (y s) / 4) by (apply sin_asin; lra).
    pose proof (asin_bound (range (x s) (y s) / 4)).
    assert (PI / 2 - e <= asin (range (x s) (y s) / 4)); [|lra].
    apply Rnot_lt_le. intros lt.
    assert (sin (asin (range (x s) (y s) / 4)) < sin (PI / 2 - e)) by (apply sin_increasing_1; lra). lra.
  Qed.

  (** On leaving, the least time is not above that in either direction. *)
  Lemma no_drop_on_leaving eps : y t <= 0 -> outer_sq (x t) (y t) <= 4 -> y t = 0 \/ outer_sq (x t) (y t) = 4 -> 0 < eps ->
    at_left t (fun s => V s <= least_time (x t) (y t) + eps).
  Proof.
    intros down within edge epos. unfold least_time. rewrite Rabs_left1 by exact down.
    destruct (Req_dec (outer_sq (x t) (y t)) 4) as [on|off].
    - pose proof (leaves_right on) as right.
      assert (q4 : range_sq (x t) (- y t) = 4) by (unfold range_sq, outer_sq in *; lra).
      assert (value : least_time_up (x t) (- y t) = time_rsl (x t) (- y t)).
      { unfold least_time_up. destruct (Req_EM_T _ _) as [zero|_]; [lra|]. destruct (Rle_dec 4 _) as [_|no]; [reflexivity|lra]. }
      rewrite value, <- (rl_right_on_last_circle _ _ down right on). exact (leaves_last_circle eps down on epos).
    - assert (level : y t = 0) by (destruct edge; [assumption|contradiction]).
      rewrite level, Ropp_0 in *. assert (xx : x t * x t < 3) by (unfold outer_sq in *; lra).
      assert (value : least_time_up (x t) 0 = if left_first_dec (x t) 0 then time_lrl (x t) 0 else time_rl (x t) 0).
      { unfold least_time_up. destruct (Req_EM_T _ _) as [zero|_]; [unfold range_sq in zero; nra|].
        destruct (Rle_dec 4 _) as [far|_]; [unfold range_sq in far; lra|reflexivity]. }
      rewrite value. clear value. pose proof lx as lx'. pose proof ly as ly'.
      destruct (Rlt_dec (x t) 0) as [left|right].
      + assert (Pb : 1 < outer_sq (x t) 0 < 4) by (unfold outer_sq; nra).
        destruct (left_first_dec (x t) 0) as [_|no].
        2:{ exfalso. apply no. split; [lra|]. pose proof (curve_x_nonneg (outer_sq (x t) 0) ltac:(lra)). lra. }
        pose proof (fl_outer_sq x y _ _ lx' ly') as lo.
        generalize (filter_and _ _ (fl_below _ _ 0 left lx') (filter_and _ _ (fl_above _ _ 1 (proj1 Pb) lo) (filter_and _ _ (fl_below _ _ 4 (proj2 Pb) lo)
          (lc_close_at (fun s => time_lrl (x s) (y s)) t _ (fl_time_lrl x y _ _ lx' ly' (off_cut_left _ 0 left)
            (reachable_above _ (conj (Rlt_le _ _ (proj1 Pb)) (proj2 Pb)))) eps epos)))).
        apply filter_imp. intros s (h1 & h2 & h3 & h4).
        assert (lb : left_below (x s) (y s)).
        { split; [exact h1|]. assert (b1 : 1 <= outer_sq (x s) (y s) < 4) by lra. split; [exact (reachable_above _ b1)|].
          pose proof (outer_angle_left (x s) (y s) h1). pose proof (m_of_above _ b1) as m0.
          pose proof (c_pos _ (proper_inside _ (s_of_proper _ b1))). destruct (s_of_proper _ b1) as [spos _].
          assert (0 <= turn_to (m_of (s_of (outer_sq (x s) (y s)))) (s_of (outer_sq (x s) (y s)))); [|lra].
          unfold turn_to. apply atan_nonneg. apply Rmult_le_pos; [apply Rmult_le_pos; lra|left; apply Rinv_0_lt_compat].
          assert (0 <= m_of (s_of (outer_sq (x s) (y s))) * s_of (outer_sq (x s) (y s))) by (apply Rmult_le_pos; lra). lra. }
        pose proof (below_le_lrl _ _ lb). unfold V. lra.
      + assert (value : (if left_first_dec (x t) 0 then time_lrl (x t) 0 else time_rl (x t) 0) = time_rl_left (x t) 0).
        { rewrite <- (time_rl_on_the_right (x t) 0) by lra. destruct (left_first_dec (x t) 0) as [[inn le]|_]; [|reflexivity].
          apply times_on_curve; [lra|exact inn|]. assert (Pb : 1 <= outer_sq (x t) 0 < 4) by (unfold outer_sq in *; nra).
          destruct (facts (x t) 0 ltac:(lra) inn) as (spos & mpos & cpos & cc & ww & mw & wpos & mP).
          pose proof (curve_on_circle (x t) 0 ltac:(lra) inn) as circle. unfold curve_x in *.
          set (s := s_of (outer_sq (x t) 0)) in *.
          assert (ms : 0 <= m_of s * s) by (apply Rmult_le_pos; lra).
          assert (low : m_of s * s <= 0).
          { apply (lower_to_the_right (x t) 0 (m_of s * c_of s) (m_of s * s)); try lra. unfold outer_sq at 2. rewrite circle. reflexivity. }
          assert (zero : m_of s * s = 0) by lra. assert (m0 : m_of s = 0) by nra. rewrite m0 in *. lra. }
        rewrite value.
        generalize (lc_close_at (fun s => time_rl_left (x s) (y s)) t _ (fl_time_rl_left x y _ _ lx' ly' ltac:(lra)
          ltac:(unfold range_sq; lra)) eps epos).
        apply filter_imp. intros s h. pose proof (below_le_left (x s) (y s)). unfold V. lra.
  Qed.
End Leaving.

(** From below the axis, within the last circle: to the moment of leaving, and on from there in either direction. *)
Lemma not_sooner_below x y u tau : trajectory x y u tau -> x tau = 0 -> y tau = 1 ->
  y 0 < 0 -> outer_sq (x 0) (y 0) < 4 -> least_time_below (x 0) (y 0) <= tau.
Proof.
  intros tr tx ty down0 within0. pose proof (duration_nonneg _ _ _ _ tr) as tau0.
  set (In := fun s => y s < 0 /\ outer_sq (x s) (y s) < 4).
  set (S := fun t => 0 <= t <= tau /\ forall s, 0 <= s <= t -> In s).
  destruct (completeness S) as [t1 [upper least]].
  { exists tau. intros t [[_ le] _]. exact le. }
  { exists 0. split; [lra|]. intros s sb. replace s with 0 by lra. split; assumption. }
  assert (first : 0 <= t1) by (apply upper; split; [lra|]; intros s sb; replace s with 0 by lra; split; assumption).
  assert (last : t1 <= tau) by (apply least; intros t [[_ le] _]; exact le).
  assert (before : forall s, 0 <= s < t1 -> In s).
  { intros s sb. apply NNPP. intros out. assert (t1 <= s); [|lra]. apply least. intros t [tb all].
    apply Rnot_lt_le. intros lt. apply out, all. lra. }
  assert (open : forall t, 0 <= t < tau -> In t -> exists d, 0 < d /\ forall s, t < s < t + d -> In s).
  { intros t tb [dn wn]. pose proof (right_x x y u tau tr t tb) as rx. pose proof (right_y x y u tau tr t tb) as ry.
    destruct (filter_and _ _ (fl_below _ _ 0 dn ry) (fl_below _ _ 4 wn (fl_outer_sq x y _ _ rx ry))) as [[d dpos] H].
    exists d. split; [exact dpos|]. intros s near. apply H; [change (Rabs (s - t) < d); apply Rabs_lt_between; lra|lra]. }
  assert (leaves : ~ In t1).
  { intros here. destruct last as [lt|eq]; [|rewrite eq in here; destruct here; lra].
    destruct (open t1 ltac:(lra) here) as [d [dpos H]].
    pose proof (Rmin_l (d / 2) (tau - t1)). pose proof (Rmin_r (d / 2) (tau - t1)).
    assert (0 < Rmin (d / 2) (tau - t1)) by (apply Rmin_pos; lra).
    assert (t1 + Rmin (d / 2) (tau - t1) <= t1); [|lra]. apply upper. split; [lra|]. intros s sb.
    destruct (Rtotal_order s t1) as [l|[->|g]]; [apply before; lra|exact here|apply H; lra]. }
  assert (pos : 0 < t1).
  { destruct first as [lt|eq]; [exact lt|]. exfalso. apply leaves. rewrite <- eq. split; assumption. }
  assert (edge : y t1 <= 0 /\ outer_sq (x t1) (y t1) <= 4).
  { pose proof (left_x x y u tau tr t1 ltac:(lra)) as lx. pose proof (left_y x y u tau tr t1 ltac:(lra)) as ly.
    pose proof (fl_outer_sq x y _ _ lx ly) as lo. pose proof (before_here tau t1 (conj pos last)) as bh.
    split; apply Rnot_lt_le; intros beyond.
    - destruct (filter_ex _ (filter_and _ _ bh (fl_above _ _ 0 beyond ly))) as [s [sb ps]]. destruct (before s sb). lra.
    - destruct (filter_ex _ (filter_and _ _ bh (fl_above _ _ 4 beyond lo))) as [s [sb ps]]. destruct (before s sb). lra. }
  destruct edge as [down within].
  assert (border : y t1 = 0 \/ outer_sq (x t1) (y t1) = 4).
  { destruct down as [dn|eq]; [|left; exact eq]. destruct within as [wn|eq]; [|right; exact eq].
    exfalso. apply leaves. split; assumption. }
  (* the rest, in either direction *)
  assert (rest : least_time (x t1) (y t1) <= tau - t1).
  { pose proof (not_sooner_either _ _ _ _ (rest_of x y u tau t1 tr ltac:(lra))) as later. cbv beta in later. rewrite Rplus_0_r in later.
    replace (t1 + (tau - t1)) with tau in later by ring. apply later; [exact tx|rewrite ty; apply Rabs_R1]. }
  set (f := fun t => (if Rlt_dec t t1 then least_time_below (x t) (y t) else least_time (x t1) (y t1)) + t).
  assert (f 0 <= f t1).
  { apply never_falls; [lra| |].
    - intros t tb eps epos. destruct (before t tb) as [dn wn].
      destruct (falls_slowly_below x y u tau tr t eps ltac:(lra) dn wn epos) as [[d dpos] H].
      pose proof (Rmin_l d (t1 - t)). pose proof (Rmin_r d (t1 - t)). exists (Rmin d (t1 - t)).
      split; [apply Rmin_pos; lra|]. intros s near _. unfold f.
      destruct (Rlt_dec t t1); [|lra]. destruct (Rlt_dec s t1); [|lra].
      apply H; [change (Rabs (s - t) < d); apply Rabs_lt_between; lra|lra].
    - intros t tb eps epos.
      assert (close : at_left t (fun s => f s - s <= f t - t + eps)).
      { destruct (Rlt_dec t t1) as [lt|ge].
        - destruct (before t ltac:(lra)) as [dn wn].
          destruct (no_drop_below x y u tau tr t eps ltac:(lra) dn wn epos) as [d H]. exists d. intros s n b.
          specialize (H s n b). unfold f. destruct (Rlt_dec s t1); [|lra]. destruct (Rlt_dec t t1); lra.
        - assert (same : t = t1) by lra. subst t.
          destruct (no_drop_on_leaving x y u tau t1 tr ltac:(lra) before eps down within border epos) as [d H]. exists d.
          intros s n b. specialize (H s n b). unfold f. destruct (Rlt_dec s t1); [|lra]. destruct (Rlt_dec t1 t1); lra. }
      destruct close as [[d dpos] H]. exists d. split; [exact dpos|]. intros s near _.
      assert (f s - s <= f t - t + eps); [|lra]. apply H; [change (Rabs (s - t) < d); apply Rabs_lt_between; lra|lra]. }
  unfold f in H. destruct (Rlt_dec 0 t1); [|lra]. destruct (Rlt_dec t1 t1); lra.
Qed.

(** * The theorem *)

(** Some flight onto the clockwise circle takes [least_time_clockwise] of its reduced state. *)
Theorem least_time_clockwise_is_flown X0 Y0 th0 :
  exists X Y th u, flight X Y th u (least_time_clockwise (along X0 Y0 th0) (across X0 Y0 th0))
    /\ X 0 = X0 /\ Y 0 = Y0 /\ th 0 = th0
    /\ let T := least_time_clockwise (along X0 Y0 th0) (across X0 Y0 th0) in on_clockwise_circle 1 (X T) (Y T) (th T).
Proof.
  set (x0 := along X0 Y0 th0). set (y0 := across X0 Y0 th0).
  destruct (from_reduced X0 Y0 th0) as [backX backY]. fold x0 y0 in backX, backY.
  destruct (flown _ _ _ _ _ th0 (attained_clockwise x0 y0)) as (X & Y & th & u & fl & eX & eY & eth & fX & fY).
  exists X, Y, th, u. split; [exact fl|]. split; [rewrite eX, <- backX; reflexivity|].
  split; [rewrite eY, <- backY; reflexivity|]. split; [exact eth|].
  simpl. rewrite fX, fY. split; ring.
Qed.

(** No flight onto the clockwise circle takes less. *)
Theorem least_time_clockwise_is_least X0 Y0 th0 X Y th u T :
  flight X Y th u T -> X 0 = X0 -> Y 0 = Y0 -> th 0 = th0 -> on_clockwise_circle 1 (X T) (Y T) (th T) ->
  least_time_clockwise (along X0 Y0 th0) (across X0 Y0 th0) <= T.
Proof.
  intros fl <- <- <- [endX endY]. rewrite Rmult_1_l in endX, endY.
  pose proof (reduced _ _ _ _ _ fl) as tr.
  assert (tx : along (X T) (Y T) (th T) = 0) by (unfold along; rewrite endX, endY; ring).
  assert (ty : across (X T) (Y T) (th T) = 1).
  { unfold across. rewrite endX, endY. pose proof (sin2_cos2 (th T)) as one. unfold Rsqr in one. lra. }
  assert (level : Rabs (across (X T) (Y T) (th T)) = 1) by (rewrite ty; apply Rabs_R1).
  pose proof (not_sooner_either _ _ _ _ tr tx level) as either. cbv beta in either.
  unfold least_time_clockwise. unfold least_time in either.
  destruct (Rle_dec 0 _) as [up|down]; [rewrite Rabs_right in either by lra; exact either|].
  destruct (Rle_dec 4 _) as [far|within]; [rewrite Rabs_left in either by lra; exact either|].
  apply (not_sooner_below _ _ _ _ tr); simpl; [exact tx|exact ty|lra|lra].
Qed.
