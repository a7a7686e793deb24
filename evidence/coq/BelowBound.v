(** From below the axis, within the last circle, no trajectory arrives clockwise sooner than by the best of RL with
    either crossing and LRL. *)

Require Import Reals Lra Classical.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound Below BelowCurve.
Open Scope R_scope.

Lemma left_below_dec x y : {left_below x y} + {~ left_below x y}.
Proof.
  unfold left_below, reachable. destruct (Rlt_dec x 0); [|right; tauto].
  destruct (Rlt_dec 0 (outer_sq x y)); [|right; tauto]. destruct (Rlt_dec (outer_sq x y) 4); [|right; tauto].
  destruct (Rlt_dec 0 (discriminant (outer_sq x y))); [|right; tauto].
  destruct (Rle_dec (outer_angle x y) (turn_to (m_of (s_of (outer_sq x y))) (s_of (outer_sq x y)))); [left|right]; tauto.
Qed.

(** The least time onto the clockwise circle from below the axis, within the last circle. *)
Definition least_time_below (x y : R) : R :=
  let right_first := Rmin (time_rl_left x y) (time_rl_right x y) in
  if left_below_dec x y then Rmin right_first (time_lrl x y) else right_first.

Lemma below_le_left x y : least_time_below x y <= time_rl_left x y.
Proof.
  unfold least_time_below. pose proof (Rmin_l (time_rl_left x y) (time_rl_right x y)).
  pose proof (Rmin_l (Rmin (time_rl_left x y) (time_rl_right x y)) (time_lrl x y)). destruct (left_below_dec x y); lra.
Qed.

Lemma below_le_right x y : least_time_below x y <= time_rl_right x y.
Proof.
  unfold least_time_below. pose proof (Rmin_r (time_rl_left x y) (time_rl_right x y)).
  pose proof (Rmin_l (Rmin (time_rl_left x y) (time_rl_right x y)) (time_lrl x y)). destruct (left_below_dec x y); lra.
Qed.

Lemma below_le_lrl x y : left_below x y -> least_time_below x y <= time_lrl x y.
Proof.
  intros lb. unfold least_time_below. destruct (left_below_dec x y); [apply Rmin_r|contradiction].
Qed.

Lemma below_cases x y (v : R) :
  v <= time_rl_left x y -> v <= time_rl_right x y -> (left_below x y -> v <= time_lrl x y) -> v <= least_time_below x y.
Proof.
  intros l r z. unfold least_time_below. destruct (left_below_dec x y) as [yes|no]; repeat apply Rmin_glb; auto.
Qed.

Lemma below_is x y : least_time_below x y = time_rl_left x y \/ least_time_below x y = time_rl_right x y
  \/ (left_below x y /\ least_time_below x y = time_lrl x y).
Proof.
  unfold least_time_below. destruct (left_below_dec x y) as [yes|no]; repeat (unfold Rmin; destruct (Rle_dec _ _)); tauto.
Qed.

(** ** Which crossing is sooner *)

Lemma asin_sixth v : 0 <= v <= 1 -> (v < 1 / 2 -> asin v < PI / 6) /\ (1 / 2 < v -> PI / 6 < asin v).
Proof.
  intros vb. pose proof PI_RGT_0. pose proof (asin_bound v). assert (sv : sin (asin v) = v) by (apply sin_asin; lra). split.
  - intros lt. apply Rnot_le_lt. intros le. assert (ss : sin (PI / 6) <= sin (asin v)).
    { destruct le as [less|same]; [left; apply sin_increasing_1; lra|rewrite same; apply Rle_refl]. }
    rewrite sin_PI6 in ss. lra.
  - intros lt. apply Rnot_le_lt. intros le. assert (ss : sin (asin v) <= sin (PI / 6)).
    { destruct le as [less|same]; [left; apply sin_increasing_1; lra|rewrite <- same; apply Rle_refl]. }
    rewrite sin_PI6 in ss. lra.
Qed.

Lemma crossings x y : range_sq x y < 16 ->
  (range_sq x y < 4 -> time_rl_left x y < time_rl_right x y) /\ (4 < range_sq x y -> time_rl_right x y < time_rl_left x y).
Proof.
  intros near. pose proof (range_range x y) as rr. assert (r0 : 0 <= range x y) by apply sqrt_pos.
  destruct (asin_sixth (range x y / 4)) as [lo hi]; [split; nra|]. unfold time_rl_left, time_rl_right. split; intros side.
  - assert (half : range x y / 4 < 1 / 2) by nra. specialize (lo half). lra.
  - assert (half : 1 / 2 < range x y / 4) by nra. specialize (hi half). lra.
Qed.

Lemma range_within x y : y < 0 -> outer_sq x y < 4 -> range_sq x y < 16.
Proof. intros down inside. rewrite outer_range in inside. unfold range_sq, outer_sq in *. nra. Qed.

Lemma outer_sq_pos x y : x < 0 -> 0 < outer_sq x y.
Proof. intros left. unfold outer_sq. assert (0 < - x * - x) by (apply Rmult_lt_0_compat; lra). pose proof (Rle_0_sqr (y + 1)). unfold Rsqr in *. lra. Qed.

(** ** Along a trajectory *)

Section BelowTrajectory.
  Variables x y u : R -> R.
  Variable tau : R.
  Hypothesis tr : trajectory x y u tau.

  Let V t := least_time_below (x t) (y t).

  (** A function that is larger than the value now is not smaller soon. *)
  Lemma later_above (f : R -> R) t v eps : v < f t -> filterlim f (at_right t) (locally (f t)) -> 0 < eps ->
    at_right t (fun s => v + t - eps * (s - t) <= f s + s).
  Proof.
    intros lt lf epos. assert (after : at_right t (fun s => t < s)) by (exists (mkposreal 1 Rlt_0_1); intros; assumption).
    generalize (filter_and _ _ after (fl_above f _ v lt lf)). apply filter_imp. intros s [later big]. nra.
  Qed.

  (** A word whose margin has the right sign falls slowly, and with it whatever it bounds. *)
  Lemma later_slow (f : R -> R) t v k eps : v <= f t -> 0 <= k -> right_derive f t (-1 + k) -> 0 < eps ->
    at_right t (fun s => v + t - eps * (s - t) <= f s + s).
  Proof.
    intros le k0 rd epos. generalize (rd_slow f t k k0 rd eps epos). apply filter_imp. intros s h. lra.
  Qed.

  Section At.
    Variables t eps : R.
    Hypothesis inside : 0 <= t < tau.
    Hypothesis down : y t < 0.
    Hypothesis within : outer_sq (x t) (y t) < 4.
    Hypothesis epos : 0 < eps.

    Let mv := tr_moves x y u tau tr t inside.
    Let rx := right_x x y u tau tr t inside.
    Let ry := right_y x y u tau tr t inside.
    Let near := range_within _ _ down within.

    Lemma control_rate k : 0 <= k -> 0 <= (1 + u t) * k /\ 0 <= (1 - u t) * k.
    Proof. intros k0. destruct mv as [ub _]. split; apply Rmult_le_pos; lra. Qed.

    Lemma margin_rate k : 0 <= k -> 0 <= (1 + u t) * k / (range_sq (x t) (y t) * sqrt (16 - range_sq (x t) (y t))).
    Proof.
      intros k0. destruct (range_below (x t) (y t) ltac:(lra)) as [qpos _]. apply Rmult_le_pos; [apply control_rate, k0|].
      left. apply Rinv_0_lt_compat, Rmult_lt_0_compat; [exact qpos|apply sqrt_lt_R0]. pose proof near. lra.
    Qed.

    Lemma slow_left : at_right t (fun s => V t + t - eps * (s - t) <= time_rl_left (x s) (y s) + s).
    Proof.
      pose proof near as nr. pose proof (below_le_left (x t) (y t)) as le.
      pose proof (fl_time_rl_left x y _ _ rx ry ltac:(lra) nr) as lf.
      destruct (Rlt_dec 4 (range_sq (x t) (y t))) as [far|close].
      { apply (later_above (fun s => time_rl_left (x s) (y s)) t (V t) eps); [|exact lf|exact epos].
        destruct (crossings (x t) (y t) nr) as [_ sooner]. specialize (sooner far).
        pose proof (below_le_right (x t) (y t)). unfold V. lra. }
      destruct (Rle_dec 0 (x t)) as [right|left].
      { apply (later_slow (fun s => time_rl_left (x s) (y s)) t (V t) _ eps le) with (2 := rd_time_rl_left x y t (u t) mv ltac:(lra) nr);
          [|exact epos]. apply margin_rate, rl_margin_below; [exact within|exact nr|lra|left; exact right]. }
      destruct (Rle_dec (tangency (outer_sq (x t) (y t)) (y t)) 0) as [good|bad].
      { apply (later_slow (fun s => time_rl_left (x s) (y s)) t (V t) _ eps le) with (2 := rd_time_rl_left x y t (u t) mv ltac:(lra) nr);
          [|exact epos]. apply margin_rate, rl_margin_below; [exact within|exact nr|lra|right; exact good]. }
      apply (later_above (fun s => time_rl_left (x s) (y s)) t (V t) eps); [|exact lf|exact epos].
      pose proof (lrl_sooner (x t) (y t) ltac:(lra) within ltac:(lra)).
      pose proof (below_le_lrl _ _ (improved_before (x t) (y t) ltac:(lra) within ltac:(lra))). unfold V. lra.
    Qed.

    Lemma slow_right : at_right t (fun s => V t + t - eps * (s - t) <= time_rl_right (x s) (y s) + s).
    Proof.
      pose proof near as nr. pose proof (below_le_right (x t) (y t)) as le.
      destruct (Rle_dec 4 (range_sq (x t) (y t))) as [far|close].
      - apply (later_slow (fun s => time_rl_right (x s) (y s)) t (V t) _ eps le) with (2 := rd_time_rl_right x y t (u t) mv ltac:(lra) nr);
          [|exact epos]. apply margin_rate, rl_right_margin_below; [exact within|exact nr|lra|exact far].
      - apply (later_above (fun s => time_rl_right (x s) (y s)) t (V t) eps); [| |exact epos].
        + destruct (crossings (x t) (y t) nr) as [sooner _]. specialize (sooner ltac:(lra)).
          pose proof (below_le_left (x t) (y t)). unfold V. lra.
        + exact (fl_time_rl_right x y _ _ rx ry ltac:(lra) nr).
    Qed.

    Let lo := fl_outer_sq x y _ _ rx ry.
    Let ld := fl_discriminant (fun s => outer_sq (x s) (y s)) _ lo.

    Lemma after : at_right t (fun s => t < s).
    Proof. exists (mkposreal 1 Rlt_0_1). intros; assumption. Qed.

    (** On the vertical through the centres. *)
    Lemma slow_lrl_middle : x t = 0 ->
      at_right t (fun s => left_below (x s) (y s) -> V t + t - eps * (s - t) <= time_lrl (x s) (y s) + s).
    Proof.
      intros middle. pose proof near as nr. pose proof PI_RGT_0.
      assert (Pt : outer_sq (x t) (y t) = (y t + 1) * (y t + 1)) by (unfold outer_sq; rewrite middle; ring).
      assert (qt : range_sq (x t) (y t) = (1 - y t) * (1 - y t)) by (unfold range_sq; rewrite middle; ring).
      destruct (Rtotal_order (y t) (- (1))) as [low|[level|high]].
      - (* below the centre of L the first arc is almost half a turn *)
        assert (bound : V t < 2 * PI).
        { eapply Rle_lt_trans; [apply below_le_right|]. unfold time_rl_right, lower_angle.
          assert (zero : x t / (1 - y t) = 0) by (rewrite middle; field; lra). rewrite zero, atan_0.
          assert (r : range (x t) (y t) = 1 - y t) by (unfold range; rewrite qt; apply sqrt_square; lra).
          assert (high : - (3) <= y t).
          { pose proof within as wt. rewrite Pt in wt. apply Rnot_lt_le. intros lt.
            assert (2 * 2 <= - (y t + 1) * - (y t + 1)) by (apply Rmult_le_compat; lra). lra. }
          destruct (asin_sixth ((1 - y t) / 4)) as [_ hi]; [lra|].
          rewrite r. specialize (hi ltac:(lra)). lra. }
        set (eta := Rmin 1 (2 * PI - V t)). assert (e1 : eta <= 1) by apply Rmin_l.
        assert (e2 : eta <= 2 * PI - V t) by apply Rmin_r. assert (e0 : 0 < eta) by (apply Rmin_pos; lra).
        assert (ce : cos eta < 1) by (rewrite <- cos_0; apply cos_decreasing_1; pose proof PI2_1; lra).
        assert (lh : filterlim (fun s => y s + 1 + sqrt (outer_sq (x s) (y s)) * cos eta) (at_right t)
            (locally (y t + 1 + sqrt (outer_sq (x t) (y t)) * cos eta))).
        { apply fl_plus; [apply fl_plus; [exact ry|apply fl_const]|]. apply fl_mult; [|apply fl_const].
          apply fl_sqrt; [apply outer_sq_nonneg|exact lo]. }
        assert (neg : y t + 1 + sqrt (outer_sq (x t) (y t)) * cos eta < 0).
        { rewrite Pt. replace ((y t + 1) * (y t + 1)) with ((- (y t + 1)) * (- (y t + 1))) by ring.
          rewrite sqrt_square by lra. nra. }
        generalize (filter_and _ _ after (fl_below _ _ 0 neg lh)). apply filter_imp. intros s [later ys] lb.
        destruct (arc_facts _ _ lb) as (hb & hh & sa & ca & sb & cb & ab & bb). destruct lb as (left & on & before).
        pose proof (arcs_above _ on) as more.
        assert (far : outer_angle (x s) (y s) <= - PI + eta).
        { apply Rnot_lt_le. intros lt. assert (cos (PI - eta) < cos (- outer_angle (x s) (y s)))
            by (apply cos_decreasing_1; pose proof PI2_1; lra).
          rewrite cos_neg, Rtrigo_facts.cos_pi_minus in H0.
          pose proof (scaled_lt _ _ _ (proj1 hb) H0). lra. }
        unfold time_lrl. nra.
      - (* at the centre of L there is no LRL *)
        assert (neg : discriminant (outer_sq (x t) (y t)) < 0) by (rewrite Pt, level; unfold discriminant; lra).
        generalize (fl_below _ _ 0 neg ld). apply filter_imp. intros s lt (_ & [_ pos] & _). lra.
      - (* above it LRL is considered farther on the left only *)
        assert (P1 : outer_sq (x t) (y t) < 1) by (rewrite Pt; nra).
        assert (lg : filterlim (fun s => x s + (1 - outer_sq (x s) (y s)) / 4) (at_right t)
            (locally (x t + (1 - outer_sq (x t) (y t)) / 4))).
        { apply fl_plus; [exact rx|]. apply fl_mult; [|apply fl_const]. apply fl_minus; [apply fl_const|exact lo]. }
        assert (p1 : 0 < x t + (1 - outer_sq (x t) (y t)) / 4) by lra. assert (p2 : 0 < y t + 1) by lra.
        assert (up : filterlim (fun s => y s + 1) (at_right t) (locally (y t + 1))) by (apply fl_plus; [exact ry|apply fl_const]).
        generalize (filter_and _ _ (fl_below _ _ 1 P1 lo) (filter_and _ _ (fl_above _ _ 0 p1 lg) (fl_above _ _ 0 p2 up))).
        apply filter_imp. intros s (Ps & gs & ys) lb. exfalso.
        destruct (arc_facts _ _ lb) as (hb & hh & sa & ca & sb & cb & ab & bb). destruct lb as (left & on & before).
        pose proof (curve_left _ on Ps) as cl.
        set (h := sqrt (outer_sq (x s) (y s))) in *. set (a := outer_angle (x s) (y s)) in *.
        set (b := turn_to (m_of (s_of (outer_sq (x s) (y s)))) (s_of (outer_sq (x s) (y s)))) in *.
        assert (cospos : 0 < cos a) by (apply Rmult_lt_reg_l with h; lra).
        assert (aq : - (PI / 2) < a).
        { apply Rnot_le_lt. intros le. assert (cos (- a) <= 0) by (apply cos_le_0; lra). rewrite cos_neg in H0. lra. }
        assert (sin a <= sin b) by (destruct before as [lt|eq]; [left; apply sin_increasing_1; lra|rewrite eq; apply Rle_refl]).
        pose proof (scaled_le h _ _ ltac:(lra) H0). lra.
    Qed.

    (** Where LRL begins to exist. *)
    Lemma slow_lrl_edge : x t < 0 -> discriminant (outer_sq (x t) (y t)) = 0 ->
      at_right t (fun s => left_below (x s) (y s) -> V t + t - eps * (s - t) <= time_lrl (x s) (y s) + s).
    Proof.
      intros left edge. pose proof near as nr. set (P := outer_sq (x t) (y t)) in *.
      assert (P1 : P < 1) by (unfold discriminant in edge; nra).
      set (k := (1 - P) / 8 * ((1 - P) / 8)). assert (kpos : 0 < k) by (unfold k; nra).
      assert (half : at_right t (fun s => (1 - P) / 8 < (1 - outer_sq (x s) (y s)) / 4)).
      { apply (fl_above (fun s => (1 - outer_sq (x s) (y s)) / 4) ((1 - P) / 4)); [lra|].
        apply fl_mult; [|apply fl_const]. apply fl_minus; [apply fl_const|exact lo]. }
      assert (good : tangency P (y t) <= 0).
      { assert (64 * discriminant P = 96 * tangency P (y t)
          + (48 * (y t - 1) - (10 * P - 64)) * (48 * (y t - 1) - (10 * P - 64))) by (unfold discriminant, tangency; field).
        pose proof (pow2_ge_0 (48 * (y t - 1) - (10 * P - 64))). lra. }
      assert (first := later_slow (fun s => time_rl_left (x s) (y s)) t (V t) _ (eps / 2) (below_le_left (x t) (y t))
        (margin_rate _ (rl_margin_below (x t) (y t) within nr ltac:(lra) (or_intror good)))
        (rd_time_rl_left x y t (u t) mv ltac:(lra) nr) ltac:(lra)).
      (* the discriminant grows at a bounded rate *)
      pose proof (rd_outer_sq x y t (u t) mv) as rP.
      pose proof (rd_plus _ _ _ _ _ (rd_scal (/ 2) _ _ _ rP) (rd_const 1 t)) as rh. simpl in rh.
      pose proof (rd_minus _ _ _ _ _ (rd_square _ _ _ rh)
        (rd_scal (3 / 16) _ _ _ (rd_square _ _ _ (rd_minus _ _ _ _ _ rP (rd_const 4 t))))) as rD. simpl in rD.
      apply (rd_ext _ (fun s => discriminant (outer_sq (x s) (y s)))) in rD; [|intros; unfold discriminant; field].
      destruct (rd_bounded_rate _ _ _ rD) as [d [dpos grow]]. cbv beta in grow. fold P in grow. rewrite edge in grow.
      match type of grow with forall s, _ -> _ <= ?c * _ => set (C := c) in * end.
      assert (C1 : 1 <= C) by (unfold C; match goal with |- _ <= Rabs ?v + 1 => pose proof (Rabs_pos v) end; lra).
      assert (ls : filterlim (fun s => sqrt (discriminant (outer_sq (x s) (y s)))) (at_right t) (locally (sqrt (discriminant P)))).
      { apply fl_sqrt; [rewrite edge; lra|exact ld]. }
      rewrite edge, sqrt_0 in ls.
      assert (K0 : 0 < 8 * C / k) by (apply Rdiv_lt_0_compat; lra).
      assert (small : at_right t (fun s => sqrt (discriminant (outer_sq (x s) (y s))) < eps / 2 / (8 * C / k))).
      { apply (fl_below _ 0); [apply Rdiv_lt_0_compat; lra|exact ls]. }
      assert (close : at_right t (fun s => t < s < t + d)).
      { exists (mkposreal d dpos). intros s n a. change (Rabs (s - t) < d) in n. apply Rabs_lt_between in n. lra. }
      assert (downs : at_right t (fun s => y s < 0)) by (apply (fl_below _ _ 0 down ry)).
      generalize (filter_and _ _ downs (filter_and _ _ (fl_below _ _ 1 P1 lo) (filter_and _ _ half (filter_and _ _ first (filter_and _ _ small close))))).
      apply filter_imp. intros s (ys & Ps & hs & fs & ss & cs) lb.
      pose proof lb as (_ & on & _). pose proof (curve_left _ on Ps) as cl.
      assert (wide : k <= curve_x (outer_sq (x s) (y s)) * curve_x (outer_sq (x s) (y s))) by (unfold k; nra).
      pose proof (lrl_hardly_sooner (x s) (y s) k ltac:(lra) lb Ps kpos wide) as hardly.
      specialize (grow s cs). rewrite Rminus_0_r in grow. apply Rabs_le_between in grow.
      set (D := discriminant (outer_sq (x s) (y s))) in *. pose proof (sqrt_pos D) as q0. set (q := sqrt D) in *.
      assert (Dk : 8 * D / k <= 8 * C / k * (s - t)).
      { replace (8 * C / k * (s - t)) with (8 * (C * (s - t)) / k) by (field; lra).
        unfold Rdiv. apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat, kpos|lra]. }
      assert (last : 8 * D / k * q <= eps / 2 * (s - t)).
      { apply Rle_trans with (8 * C / k * (s - t) * q); [apply Rmult_le_compat_r; assumption|].
        replace (8 * C / k * (s - t) * q) with (q * (8 * C / k) * (s - t)) by ring. apply Rmult_le_compat_r; [lra|].
        replace (eps / 2) with (eps / 2 / (8 * C / k) * (8 * C / k)) by (field; lra). apply Rmult_le_compat_r; lra. }
      lra.
    Qed.

    Lemma slow_lrl_below :
      at_right t (fun s => left_below (x s) (y s) -> V t + t - eps * (s - t) <= time_lrl (x s) (y s) + s).
    Proof.
      pose proof near as nr.
      destruct (Rtotal_order (x t) 0) as [left|[middle|right]]; [|exact (slow_lrl_middle middle)|].
      2:{ generalize (fl_above _ _ 0 right rx). apply filter_imp. intros s pos [neg _]. lra. }
      destruct (Rtotal_order (discriminant (outer_sq (x t) (y t))) 0) as [neg|[edge|pos]]; [|exact (slow_lrl_edge left edge)|].
      { generalize (fl_below _ _ 0 neg ld). apply filter_imp. intros s lt (_ & [_ pos] & _). lra. }
      assert (on : reachable (outer_sq (x t) (y t))).
      { split; [split; [apply outer_sq_pos, left|exact within]|exact pos]. }
      pose proof (off_cut_left _ (y t) left) as off.
      destruct (left_below_dec (x t) (y t)) as [lb|no].
      - assert (slow := later_slow (fun s => time_lrl (x s) (y s)) t (V t)
          ((1 - u t) * lrl_margin (x t) (y t) / (c_of (s_of (outer_sq (x t) (y t))) * outer_sq (x t) (y t))) eps
          (below_le_lrl _ _ lb)).
        generalize (slow ltac:(apply Rmult_le_pos; [apply control_rate, lrl_margin_below; [lra|exact lb]|left; apply Rinv_0_lt_compat, Rmult_lt_0_compat;
            [apply c_pos, proper_inside, s_of_reachable, on|apply on]])
          (rd_time_lrl x y t (u t) mv off on) epos).
        apply filter_imp. intros s h _. exact h.
      - assert (gap : turn_to (m_of (s_of (outer_sq (x t) (y t)))) (s_of (outer_sq (x t) (y t))) < outer_angle (x t) (y t)).
        { apply Rnot_le_lt. intros le. apply no. split; [exact left|split; [exact on|exact le]]. }
        pose proof (fl_turn_gap (F := at_right t) x y _ _ rx ry off on) as lg.
        match type of lg with filterlim _ _ (locally ?v) => assert (p1 : 0 < v) by lra end.
        generalize (fl_above _ _ 0 p1 lg). apply filter_imp. intros s big (_ & _ & before). lra.
    Qed.

    Lemma falls_slowly_below : at_right t (fun s => V t + t - eps * (s - t) <= V s + s).
    Proof.
      generalize (filter_and _ _ slow_left (filter_and _ _ slow_right slow_lrl_below)). apply filter_imp.
      intros s (l & r & z). unfold V at 2. pose proof (below_cases (x s) (y s) (V t + t - eps * (s - t) - s)) as all.
      apply Rplus_le_reg_r with (- s). replace (least_time_below (x s) (y s) + s + - s) with (least_time_below (x s) (y s)) by ring.
      apply all; [lra|lra|]. intros lb. specialize (z lb). lra.
    Qed.
  End At.

  Lemma no_drop_below t eps : 0 < t <= tau -> y t < 0 -> outer_sq (x t) (y t) < 4 -> 0 < eps ->
    at_left t (fun s => V s <= V t + eps).
  Proof.
    intros inside down within epos. pose proof (range_within _ _ down within) as nr.
    pose proof (left_x x y u tau tr t inside) as lx. pose proof (left_y x y u tau tr t inside) as ly.
    assert (viaL : V t = time_rl_left (x t) (y t) -> at_left t (fun s => V s <= V t + eps)).
    { intros e. generalize (lc_close (fun s => time_rl_left (x s) (y s)) t (fl_time_rl_left x y _ _ lx ly ltac:(lra) nr) eps epos).
      apply filter_imp. intros s h. pose proof (below_le_left (x s) (y s)). unfold V in *. lra. }
    destruct (below_is (x t) (y t)) as [e|[e|[lb e]]]; [exact (viaL e)| |].
    { generalize (lc_close (fun s => time_rl_right (x s) (y s)) t (fl_time_rl_right x y _ _ lx ly ltac:(lra) nr) eps epos).
      apply filter_imp. intros s h. pose proof (below_le_right (x s) (y s)). unfold V in *. lra. }
    pose proof lb as (left & on & before). pose proof (off_cut_left _ (y t) left) as off.
    destruct before as [lt|eq].
    - pose proof (fl_outer_sq x y _ _ lx ly) as lo.
      pose proof (fl_turn_gap (F := at_left t) x y _ _ lx ly off on) as lg.
      match type of lg with filterlim _ _ (locally ?v) => assert (p1 : v < 0) by lra end.
      generalize (filter_and _ _ (fl_below _ _ 0 left lx) (filter_and _ _ (fl_below _ _ 4 within lo)
        (filter_and _ _ (fl_above _ _ 0 (proj1 (proj1 on)) lo)
        (filter_and _ _ (fl_above _ _ 0 (proj2 on) (fl_discriminant _ _ lo)) (filter_and _ _ (fl_below _ _ 0 p1 lg)
          (lc_close (fun s => time_lrl (x s) (y s)) t (fl_time_lrl x y _ _ lx ly off on) eps epos)))))).
      apply filter_imp. intros s (h1 & h2 & h3 & h4 & h5 & h6).
      assert (lbs : left_below (x s) (y s)) by (split; [exact h1|split; [split; [split; assumption|exact h4]|lra]]).
      pose proof (below_le_lrl _ _ lbs). unfold V in *. lra.
    - apply viaL. unfold V. rewrite e, (lrl_by_turning _ _ lb), (rl_by_turning _ _ lb), eq. reflexivity.
  Qed.
End BelowTrajectory.
