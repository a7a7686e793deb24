(** No trajectory arrives sooner than the least time: along each of them the least time falls no faster than time
    passes, and it is 0 on arrival. *)

Require Import Reals Lra Classical.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby.
Open Scope R_scope.

Lemma off_axis_far x y : 0 <= y -> 4 <= range_sq x y -> off_axis x y.
Proof.
  intros up far. pose proof sqrt3_bounds. pose proof sqrt3_sq.
  destruct (Rle_dec 0 x) as [right|left].
  - apply off_axis_right; [exact right|]. destruct (Req_dec x 0) as [->|differ]; [right|left; lra].
    intros ->. unfold range_sq in far. lra.
  - apply off_cut_intro. right. unfold aside. intros zero. assert (Y : y - 1 = sqrt 3 * x) by lra.
    unfold range_sq in far. rewrite Y in far.
    replace (sqrt 3 * x * (sqrt 3 * x)) with (sqrt 3 * sqrt 3 * (x * x)) in far by ring. rewrite H0 in far. nra.
Qed.

(** A time that falls at most at unit rate, seen a little later. *)
Lemma rd_slow V t k : 0 <= k -> right_derive V t (-1 + k) -> forall eps, 0 < eps ->
  at_right t (fun s => V t + t - eps * (s - t) <= V s + s).
Proof.
  intros pos rd eps epos. destruct (rd eps epos) as [d [dpos H]]. exists (mkposreal d dpos).
  intros s near after. change (Rabs (s - t) < d) in near. apply Rabs_lt_between in near.
  specialize (H s ltac:(lra)). apply Rabs_le_between in H. nra.
Qed.

Lemma lc_close V t : filterlim V (at_left t) (locally (V t)) -> forall eps, 0 < eps ->
  at_left t (fun s => V s <= V t + eps).
Proof.
  intros lv eps pos. apply (filter_imp (fun s => V s < V t + eps)); [intros; lra|].
  apply (fl_below V (V t)); [lra|exact lv].
Qed.

Section Trajectory.
  Variables x y u : R -> R.
  Variable tau : R.
  Hypothesis tr : trajectory x y u tau.
  Hypothesis up : forall t, 0 <= y t.

  Let W t := least_time_up (x t) (y t).

  Lemma tr_moves t : 0 <= t < tau -> moves x y t (u t).
  Proof.
    intros inside. split; [|split]; [apply (control_bounded _ _ _ _ tr)|apply (x_moves _ _ _ _ tr)|apply (y_moves _ _ _ _ tr)];
      exact inside.
  Qed.

  Lemma right_x t : 0 <= t < tau -> filterlim x (at_right t) (locally (x t)).
  Proof. intros inside. exact (rd_right_continuous _ _ _ (x_moves _ _ _ _ tr t inside)). Qed.

  Lemma right_y t : 0 <= t < tau -> filterlim y (at_right t) (locally (y t)).
  Proof. intros inside. exact (rd_right_continuous _ _ _ (y_moves _ _ _ _ tr t inside)). Qed.

  (** While the state is on the left, it does not leave the circles about [(0, -1)]. *)
  Lemma outer_falls a b : 0 <= a -> a <= b <= tau -> (forall t, a <= t < b -> x t <= 0) ->
    outer_sq (x b) (y b) <= outer_sq (x a) (y a).
  Proof.
    intros a0 ab left. apply Ropp_le_cancel.
    apply (never_falls_continuous (fun t => - outer_sq (x t) (y t))); [lra| |].
    - intros t inside. apply fl_opp.
      apply fl_outer_sq; [apply (x_continuous _ _ _ _ tr)|apply (y_continuous _ _ _ _ tr)]; lra.
    - intros t inside. assert (mv : moves x y t (u t)) by (apply tr_moves; lra).
      exists (- (2 * (1 - u t) * x t)). split.
      + destruct mv as [bound _]. specialize (left t inside). nra.
      + apply rd_opp, rd_outer_sq, mv.
  Qed.

  Lemma slow_rsl t eps : 0 <= t < tau -> 4 <= range_sq (x t) (y t) -> 0 < eps ->
    at_right t (fun s => time_rsl (x t) (y t) + t - eps * (s - t) <= time_rsl (x s) (y s) + s).
  Proof.
    intros inside far epos. pose proof (tr_moves t inside) as mv.
    pose proof (rd_time_rsl x y t (u t) mv (off_axis_far _ _ (up t) far) ltac:(lra)) as rd.
    apply (rd_slow (fun s => time_rsl (x s) (y s)) t _) with (2 := rd); [|exact epos].
    pose proof (rsl_margin_nonneg (x t) (y t) (up t) ltac:(lra)). destruct mv as [[low _] _].
    apply Rmult_le_pos; [apply Rmult_le_pos; lra|left; apply Rinv_0_lt_compat; lra].
  Qed.

  Lemma slow_rl t eps : 0 <= t < tau -> off_axis (x t) (y t) -> range_sq (x t) (y t) <= 4 ->
    0 <= rl_margin (x t) (y t) -> 0 < eps ->
    at_right t (fun s => time_rl (x t) (y t) + t - eps * (s - t) <= time_rl (x s) (y s) + s).
  Proof.
    intros inside off near margin epos. pose proof (tr_moves t inside) as mv.
    pose proof (off_axis_range _ _ off) as rpos. pose proof (range_range (x t) (y t)).
    pose proof (rd_time_rl x y t (u t) mv off ltac:(nra)) as rd.
    apply (rd_slow (fun s => time_rl (x s) (y s)) t _) with (2 := rd); [|exact epos].
    destruct mv as [[low _] _]. assert (0 < sqrt (16 - range_sq (x t) (y t))) by (apply sqrt_lt_R0; lra).
    assert (0 < range_sq (x t) (y t)) by nra.
    apply Rmult_le_pos; [apply Rmult_le_pos; lra|left; apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption].
  Qed.

  Lemma slow_lrl t eps : 0 <= t < tau -> left_first (x t) (y t) -> 0 < eps ->
    at_right t (fun s => time_lrl (x t) (y t) + t - eps * (s - t) <= time_lrl (x s) (y s) + s).
  Proof.
    intros inside [within before] epos. pose proof (tr_moves t inside) as mv.
    pose proof (up t). pose proof (rd_time_lrl x y t (u t) mv (off_cut_intro (y t + 1) (x t) ltac:(left; lra))
      (reachable_above _ (P_bounds _ _ (up t) within))) as rd.
    apply (rd_slow (fun s => time_lrl (x s) (y s)) t _) with (2 := rd); [|exact epos].
    destruct mv as [[_ high] _]. pose proof (lrl_margin_nonneg _ _ (up t) within before).
    pose proof (P_bounds _ _ (up t) within) as Pb. pose proof (c_pos _ (proper_inside _ (s_of_proper _ Pb))).
    apply Rmult_le_pos; [apply Rmult_le_pos; lra|left; apply Rinv_0_lt_compat, Rmult_lt_0_compat; lra].
  Qed.

  Lemma falls_slowly t eps : 0 <= t < tau -> 0 < eps -> at_right t (fun s => W t + t - eps * (s - t) <= W s + s).
  Proof.
    intros inside epos. unfold W.
    destruct (Req_dec (range_sq (x t) (y t)) 0) as [target|other].
    - assert (zero : least_time_up (x t) (y t) = 0).
      { unfold least_time_up. destruct (Req_EM_T _ _); [reflexivity|contradiction]. }
      exists (mkposreal 1 Rlt_0_1). intros s _ after. rewrite zero.
      pose proof (least_time_up_nonneg (x s) (y s) (up s)). nra.
    - pose proof (eventually_near x y (x t) (y t) (right_x t inside) (right_y t inside) (up t) other
        (filter_forall _ up)) as nr.
      assert (sa := eventually_if (F := at_right t) _ _ (fun h => slow_rsl t eps inside h epos)).
      assert (sc := eventually_if (F := at_right t) _ _ (fun h => slow_lrl t eps inside h epos)).
      assert (sd := eventually_if (F := at_right t) (off_axis (x t) (y t) /\ range_sq (x t) (y t) <= 4 /\ 0 <= rl_margin (x t) (y t)) _
        (fun h => slow_rl t eps inside (proj1 h) (proj1 (proj2 h)) (proj2 (proj2 h)) epos)).
      assert (after : at_right t (fun s => t < s)) by (exists (mkposreal 1 Rlt_0_1); intros; assumption).
      generalize (filter_and _ _ after (filter_and _ _ nr (filter_and _ _ sa (filter_and _ _ sc sd)))).
      apply filter_imp. intros s (later & n & ha & hc & hd).
      destruct (cases _ _ _ _ (up t) (up s) other n) as
        [(far & -> & ->)|[(lf & -> & ->)|[(off & q & m & -> & ->)|(on & left & low & lf & ->)]]].
      + apply ha, far.
      + apply hc, lf.
      + apply hd. split; [exact off|split; [exact q|exact m]].
      + pose proof (time_lrl_at_least (x s) (y s) (up s) (proj1 lf)). nra.
  Qed.

  Lemma left_x t : 0 < t <= tau -> filterlim x (at_left t) (locally (x t)).
  Proof. apply (x_continuous _ _ _ _ tr). Qed.

  Lemma left_y t : 0 < t <= tau -> filterlim y (at_left t) (locally (y t)).
  Proof. apply (y_continuous _ _ _ _ tr). Qed.

  (** Before a time at which the state is on the left, it was no nearer to [(0, -1)]. *)
  Lemma outer_before t : 0 < t <= tau -> x t < 0 ->
    at_left t (fun s => outer_sq (x t) (y t) <= outer_sq (x s) (y s)).
  Proof.
    intros inside neg. destruct (lc_epsilon x t (left_x t inside) (- x t) ltac:(lra)) as [d [dpos H]].
    pose proof (Rmin_l d t). pose proof (Rmin_r d t). assert (0 < Rmin d t) by (apply Rmin_pos; lra).
    exists (mkposreal _ H2). intros s near before. change (Rabs (s - t) < Rmin d t) in near.
    apply Rabs_lt_between in near. apply outer_falls; [lra|lra|].
    intros v vin. specialize (H v ltac:(lra)). apply Rabs_lt_between in H. lra.
  Qed.

  Lemma no_drop t eps : 0 < t <= tau -> range_sq (x t) (y t) <> 0 -> 0 < eps ->
    at_left t (fun s => W s <= W t + eps).
  Proof.
    intros inside other epos. unfold W.
    pose proof (eventually_near x y (x t) (y t) (left_x t inside) (left_y t inside) (up t) other
      (filter_forall _ up)) as nr.
    pose proof (left_x t inside) as lx. pose proof (left_y t inside) as ly.
    assert (sa := eventually_if (F := at_left t) (4 <= range_sq (x t) (y t)) _ (fun h =>
      lc_close (fun s => time_rsl (x s) (y s)) t
        (fl_time_rsl x y _ _ lx ly (off_axis_far _ _ (up t) h) ltac:(lra)) eps epos)).
    assert (sc := eventually_if (F := at_left t) (left_first (x t) (y t)) _ (fun h =>
      lc_close (fun s => time_lrl (x s) (y s)) t (fl_time_lrl x y _ _ lx ly (off_cut_intro (y t + 1) (x t) ltac:(left; pose proof (up t); lra))
        (reachable_above _ (P_bounds _ _ (up t) (proj1 h)))) eps epos)).
    assert (sd := eventually_if (F := at_left t) (off_axis (x t) (y t) /\ range_sq (x t) (y t) <= 4) _ (fun h =>
      lc_close (fun s => time_rl (x s) (y s)) t (fl_time_rl x y _ _ lx ly (proj1 h) ltac:(lra)) eps epos)).
    assert (so := eventually_if (F := at_left t) (x t < 0) _ (fun h => outer_before t inside h)).
    generalize (filter_and _ _ nr (filter_and _ _ sa (filter_and _ _ sc (filter_and _ _ sd so)))).
    apply filter_imp. intros s (n & ha & hc & hd & ho).
    destruct (cases _ _ _ _ (up t) (up s) other n) as
      [(far & -> & ->)|[(lf & -> & ->)|[(off & q & m & -> & ->)|(on & left & low & lf & ->)]]].
    - apply ha, far.
    - apply hc, lf.
    - apply hd. split; assumption.
    - exfalso. specialize (ho left). destruct lf as [lt _]. lra.
  Qed.

  (** ** Arrival *)

  (** Just before it arrives the state is at the target already, or on its left and nearly level with it. *)
  Lemma arrives_level t h : 0 < t <= tau -> x t = 0 -> y t = 1 -> 0 < h <= 1 / 4 ->
    at_left t (fun s => range_sq (x s) (y s) = 0
      \/ (x s < 0 /\ Rabs (y s - 1) <= 4 * h * - x s)).
  Proof.
    intros inside tx ty hb.
    destruct (lc_epsilon x t (left_x t inside) 1 Rlt_0_1) as [d [dpos bounded]].
    set (e := Rmin d (Rmin t h)). assert (epos : 0 < e) by (apply Rmin_pos; [lra|apply Rmin_pos; lra]).
    assert (e <= d) by apply Rmin_l. assert (e <= Rmin t h) by apply Rmin_r.
    assert (Rmin t h <= t) by apply Rmin_l. assert (Rmin t h <= h) by apply Rmin_r.
    exists (mkposreal e epos). intros s0 near before. change (Rabs (s0 - t) < e) in near.
    apply Rabs_lt_between in near.
    (* M is the largest distance sideways from s0 on *)
    set (A := fun v => exists s, s0 <= s <= t /\ v = Rabs (x s)).
    destruct (completeness A) as [M [upper least]].
    { exists 1. intros v [s [sb ->]]. destruct (Req_dec s t) as [->|differ]; [rewrite tx, Rabs_R0; lra|].
      specialize (bounded s ltac:(lra)). rewrite tx, Rminus_0_r in bounded. lra. }
    { exists (Rabs (x s0)). exists s0. split; [lra|reflexivity]. }
    assert (xM : forall s, s0 <= s <= t -> Rabs (x s) <= M) by (intros s sb; apply upper; exists s; split; [exact sb|reflexivity]).
    assert (M0 : 0 <= M) by (eapply Rle_trans; [apply Rabs_pos|apply (xM s0); lra]).
    assert (yM : forall s, s0 <= s <= t -> Rabs (y s - 1) <= M * (t - s)).
    { intros s sb. apply Rabs_le. split.
      - assert (y t - M * t <= y s - M * s); [|lra]. apply Ropp_le_cancel.
        apply (never_falls_continuous (fun v => - (y v - M * v))); [lra| |].
        + intros v vb. apply fl_opp, fl_minus; [apply left_y; lra|]. apply fl_scal, lc_id.
        + intros v vb. exists (- (- (u v * x v) - M * 1)). split.
          * destruct (tr_moves v ltac:(lra)) as [ub _]. specialize (xM v ltac:(lra)). apply Rabs_le_between in xM. nra.
          * apply rd_opp, rd_minus; [apply (y_moves _ _ _ _ tr); lra|apply rd_scal, rd_id].
      - assert (y s + M * s <= y t + M * t); [|lra].
        apply (never_falls_continuous (fun v => y v + M * v)); [lra| |].
        + intros v vb. apply fl_plus; [apply left_y; lra|]. apply fl_scal, lc_id.
        + intros v vb. exists (- (u v * x v) + M * 1). split.
          * destruct (tr_moves v ltac:(lra)) as [ub _]. specialize (xM v ltac:(lra)). apply Rabs_le_between in xM. nra.
          * apply rd_plus; [apply (y_moves _ _ _ _ tr); lra|apply rd_scal, rd_id]. }
    assert (xrise : forall a b, s0 <= a -> a <= b <= t -> x a <= x b + M * h * h).
    { intros a b sa ab. assert (x a + M * h * a <= x b + M * h * b).
      { apply (never_falls_continuous (fun v => x v + M * h * v)); [lra| |].
        + intros v vb. apply fl_plus; [apply left_x; lra|]. apply fl_scal, lc_id.
        + intros v vb. exists (1 + u v * y v + M * h * 1). split.
          * destruct (tr_moves v ltac:(lra)) as [ub _].
            assert (yb : Rabs (y v - 1) <= M * h).
            { eapply Rle_trans; [apply yM; lra|]. apply Rmult_le_compat_l; lra. }
            apply Rabs_le_between in yb. nra.
          * apply rd_plus; [apply (x_moves _ _ _ _ tr); lra|apply rd_scal, rd_id]. }
      assert (M * h * (b - a) <= M * h * h) by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|lra]). lra. }
    destruct (Req_dec M 0) as [still|moving].
    - left. assert (ys := yM s0 ltac:(lra)). assert (xs := xM s0 ltac:(lra)). rewrite still in ys, xs.
      rewrite Rmult_0_l in ys. apply Rabs_le_between in ys. apply Rabs_le_between in xs.
      unfold range_sq. assert (x s0 = 0) by lra. assert (y s0 - 1 = 0) by lra. rewrite H3, H4. ring.
    - right.
      assert (somewhere : exists s, s0 <= s <= t /\ M / 2 < Rabs (x s)).
      { apply NNPP. intros none. assert (M <= M / 2); [|lra]. apply least. intros v [s [sb ->]].
        apply Rnot_lt_le. intros lt. apply none. exists s. split; assumption. }
      destruct somewhere as [s1 [sb big]].
      assert (small : M * h * h <= M / 16) by (assert (h * h <= 1 / 16) by nra; nra).
      assert (neg : x s1 < - (M / 2)).
      { pose proof (xrise s1 t ltac:(lra) ltac:(lra)) as le. rewrite tx in le.
        destruct (Rle_dec 0 (x s1)) as [pos|n]; [rewrite Rabs_right in big; lra|rewrite Rabs_left in big; lra]. }
      pose proof (xrise s0 s1 ltac:(lra) ltac:(lra)) as le.
      split; [lra|]. eapply Rle_trans; [apply yM; lra|]. nra.
  Qed.

  (** Nearly level and close to the target, on its left, RL takes little time. *)
  Lemma time_rl_level a b e : 0 < e <= PI / 3 -> off_axis a b -> a < 0 -> 0 < sin e ->
    range a b <= 4 * sin (e / 3) -> Rabs (b - 1) <= sin e * - a -> time_rl a b <= 2 * e.
  Proof.
    intros eb off neg spos short level. unfold time_rl. pose proof (off_axis_range a b off) as rpos.
    destruct (polar a b off) as [px _]. pose proof (range_range a b) as rr. pose proof (bearing_bounds a b) as bounds.
    pose proof PI_RGT_0. set (th := PI / 3 + bearing a b) in *. set (r := range a b) in *.
    assert (d : asin (r / 4) <= e / 3).
    { assert (0 < sin (e / 3) <= 1) by (split; [apply sin_gt_0; lra|apply SIN_bound]).
      assert (sd : sin (asin (r / 4)) = r / 4) by (apply sin_asin; lra).
      pose proof (asin_bound (r / 4)). apply Rnot_lt_le. intros large.
      assert (sin (e / 3) < sin (asin (r / 4))) by (apply sin_increasing_1; lra). lra. }
    assert (cpos : 0 < cos e) by (apply cos_gt_0; lra).
    assert (flat : r * cos e <= - a).
    { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. pose proof (sin2_cos2 e) as sc. unfold Rsqr in sc.
      assert (rr' : r * r = a * a + (b - 1) * (b - 1)) by (rewrite rr; reflexivity).
      assert (bb : (b - 1) * (b - 1) <= sin e * sin e * (a * a)).
      { apply Rabs_le_between in level. nra. }
      assert (c1 : cos e * cos e <= 1) by nra.
      replace (r * cos e * (r * cos e)) with ((r * r) * (cos e * cos e)) by ring. rewrite rr'.
      assert (cos e * cos e * (1 + sin e * sin e) <= 1) by nra.
      assert (a2 : 0 <= a * a) by nra. nra. }
    assert (PI - e <= th); [|unfold th in *; lra].
    apply Rnot_lt_le. intros less.
    assert (cth : cos th <= - cos e) by nra.
    destruct (Rle_dec 0 th) as [pos|n].
    - assert (cos (PI - e) < cos th) by (apply cos_decreasing_1; lra).
      rewrite Rtrigo_facts.cos_pi_minus in H0. lra.
    - assert (cos (2 * (PI / 3)) < cos (- th)) by (apply cos_decreasing_1; lra).
      rewrite cos_neg, cos_2PI3 in H0.
      assert (1 / 2 <= cos e) by (rewrite <- cos_PI3; apply cos_decr_1; lra). lra.
  Qed.

  Lemma no_drop_on_arrival t eps : 0 < t <= tau -> range_sq (x t) (y t) = 0 -> 0 < eps ->
    at_left t (fun s => W s <= eps).
  Proof.
    intros inside target epos. destruct (at_target _ _ target) as [tx ty]. pose proof PI_RGT_0.
    set (e := Rmin (eps / 2) (PI / 3)).
    assert (e0 : 0 < e) by (apply Rmin_pos; lra). assert (e1 : e <= eps / 2) by apply Rmin_l.
    assert (e2 : e <= PI / 3) by apply Rmin_r.
    assert (se : 0 < sin e) by (apply sin_gt_0; lra). assert (se3 : 0 < sin (e / 3)) by (apply sin_gt_0; lra).
    pose proof (SIN_bound e) as sb. pose proof (SIN_bound (e / 3)) as sb3.
    set (h := sin e / 4). assert (hb : 0 < h <= 1 / 4) by (unfold h; lra).
    destruct (arrives_level t h inside tx ty hb) as [[d dpos] level].
    pose proof (fl_range_sq (F := at_left t) x y _ _ (left_x t inside) (left_y t inside)) as lr.
    rewrite target in lr.
    assert (short : at_left t (fun s => range_sq (x s) (y s) < sin (e / 3) * sin (e / 3))).
    { apply (fl_below _ 0); [apply Rmult_lt_0_compat; assumption|exact lr]. }
    assert (from : at_left t (fun s => t - Rmin d t < s < t)).
    { pose proof (Rmin_r d t). assert (0 < Rmin d t) by (apply Rmin_pos; lra).
      exists (mkposreal _ H1). intros s near before. change (Rabs (s - t) < Rmin d t) in near.
      apply Rabs_lt_between in near. lra. }
    generalize (filter_and _ _ short from). apply filter_imp. intros s (close & since & before).
    pose proof (Rmin_l d t). pose proof (Rmin_r d t).
    assert (there : forall v, s <= v < t -> range_sq (x v) (y v) = 0 \/ (x v < 0 /\ Rabs (y v - 1) <= 4 * h * - x v)).
    { intros v vb. apply level; [|lra]. change (Rabs (v - t) < d). apply Rabs_lt_between. lra. }
    assert (outer : 4 <= outer_sq (x s) (y s)).
    { replace 4 with (outer_sq (x t) (y t)) by (rewrite tx, ty; unfold outer_sq; ring).
      apply outer_falls; [lra|lra|]. intros v vb. destruct (there v vb) as [zero|[neg _]]; [|lra].
      destruct (at_target _ _ zero). lra. }
    unfold W, least_time_up. destruct (Req_EM_T _ _) as [_|other]; [lra|].
    destruct (Rle_dec 4 _) as [far|_]; [exfalso; nra|].
    destruct (left_first_dec _ _) as [[lt _]|_]; [exfalso; lra|].
    destruct (there s ltac:(lra)) as [zero|[neg flat]]; [contradiction|].
    assert (time_rl (x s) (y s) <= 2 * e); [|lra].
    apply time_rl_level; try assumption.
    - lra.
    - apply off_axis_outside; [apply up|exact other|nra|exact outer].
    - pose proof (range_range (x s) (y s)). assert (0 <= range (x s) (y s)) by apply sqrt_pos. nra.
    - replace (sin e) with (4 * h) by (unfold h; field). exact flat.
  Qed.

  Theorem not_sooner_up : x tau = 0 -> y tau = 1 -> least_time_up (x 0) (y 0) <= tau.
  Proof.
    intros tx ty. pose proof (duration_nonneg _ _ _ _ tr).
    assert (end_ : W tau = 0).
    { unfold W, least_time_up. rewrite tx, ty. destruct (Req_EM_T _ _) as [_|no]; [reflexivity|].
      exfalso. apply no. unfold range_sq. ring. }
    assert (W 0 + 0 <= W tau + tau); [|unfold W in *; lra].
    apply (never_falls (fun t => W t + t) 0 tau); [lra| |].
    - intros t inside eps epos. destruct (falls_slowly t eps inside epos) as [[d dpos] H1].
      exists d. split; [exact dpos|]. intros s near _. apply H1; [|lra].
      change (Rabs (s - t) < d). apply Rabs_lt_between. lra.
    - intros t inside eps epos.
      assert (close : at_left t (fun s => W s <= W t + eps)).
      { destruct (Req_dec (range_sq (x t) (y t)) 0) as [zero|other].
        - assert (W t = 0) by (unfold W, least_time_up; destruct (Req_EM_T _ _); [reflexivity|contradiction]).
          rewrite H0, Rplus_0_l. apply no_drop_on_arrival; [lra|exact zero|exact epos].
        - apply no_drop; [lra|exact other|exact epos]. }
      destruct close as [[d dpos] H1]. exists d. split; [exact dpos|]. intros s near _.
      assert (W s <= W t + eps); [|lra]. apply H1; [|lra].
      change (Rabs (s - t) < d). apply Rabs_lt_between. lra.
  Qed.
End Trajectory.
