(** The words with a straight piece onto circles of any radius, on their edges: where the first turn ends at the start, so
    that a time jumps by a whole turn to one side, and where the first turn has the radius 1, so that a time has a root. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound Wider WiderMargin.
Open Scope R_scope.

(** ** By how much a number exceeds its arctangent *)

Definition excess (v : R) : R := v - atan v.

Lemma is_derive_excess v : is_derive excess v (v * v / (1 + v * v)).
Proof. unfold excess. auto_derive; [exact I|]. unfold Rsqr. field. nra. Qed.

Lemma excess_grows a b : a <= b -> excess a <= excess b.
Proof.
  intros le. apply (never_falls_continuous excess); [exact le| |].
  - intros t _. exact (lc_of_derive _ _ _ (is_derive_excess t)).
  - intros t _. exists (t * t / (1 + t * t)). split; [|exact (rd_of_derive _ _ _ (is_derive_excess t))].
    apply Rmult_le_pos; [nra|left; apply Rinv_0_lt_compat; nra].
Qed.

Lemma excess_0 : excess 0 = 0.
Proof. unfold excess. rewrite atan_0. ring. Qed.

Lemma excess_cubic v : 0 <= v -> 0 <= excess v <= v * (v * v).
Proof.
  intros nonneg. split; [rewrite <- excess_0; apply excess_grows, nonneg|].
  assert (H : 0 * (0 * 0) - excess 0 <= v * (v * v) - excess v); [|rewrite excess_0 in H; lra].
  assert (deriv : forall t, is_derive (fun t => t * (t * t) - excess t) t (3 * (t * t) - t * t / (1 + t * t))).
  { intros t. apply (is_derive_minus (fun t => t * (t * t)) excess); [auto_derive; [exact I|ring]|apply is_derive_excess]. }
  apply (never_falls_continuous (fun t => t * (t * t) - excess t)); [exact nonneg| |].
  - intros t _. exact (lc_of_derive _ _ _ (deriv t)).
  - intros t _. exists (3 * (t * t) - t * t / (1 + t * t)). split; [|exact (rd_of_derive _ _ _ (deriv t))].
    assert (t * t / (1 + t * t) <= t * t); [|nra].
    apply Rmult_le_reg_r with (1 + t * t); [nra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by nra. nra.
Qed.

Lemma excess_opp v : excess (- v) = - excess v.
Proof. unfold excess. rewrite atan_opp. ring. Qed.

(** Where the square under a root begins to be positive, the excess of the root has the rate 0. *)
Lemma rd_excess_at_root e q t q' : e = 1 \/ e = -1 -> q t = 0 -> right_derive q t q' ->
  right_derive (fun s => excess (e * sqrt (q s))) t 0.
Proof.
  intros side zero rq eps pos. destruct (rd_bounded_rate _ _ _ rq) as [d [dpos rate]].
  pose proof (rd_right_continuous _ _ _ rq) as lq. rewrite zero in lq.
  pose proof (fl_sqrt q 0 (Rle_refl 0) lq) as lr. rewrite sqrt_0 in lr. set (K := Rabs q' + 1) in *.
  assert (Kpos : 0 < K) by (unfold K; pose proof (Rabs_pos q'); lra).
  destruct (fl_below _ _ (eps / K) (Rdiv_lt_0_compat _ _ pos Kpos) lr) as [[d2 d2pos] small].
  pose proof (Rmin_l d d2). pose proof (Rmin_r d d2).
  exists (Rmin d d2). split; [apply Rmin_pos; assumption|]. intros s near.
  specialize (rate s ltac:(lra)). specialize (small s).
  assert (sm : sqrt (q s) < eps / K) by (apply small; [change (Rabs (s - t) < d2); apply Rabs_lt_between; lra|lra]).
  rewrite zero, sqrt_0, Rmult_0_r, excess_0. pose proof (sqrt_pos (q s)) as root.
  assert (size : Rabs (excess (e * sqrt (q s))) = excess (sqrt (q s))).
  { pose proof (excess_cubic _ root). destruct side as [-> | ->].
    - rewrite Rmult_1_l. apply Rabs_right. lra.
    - replace (-1 * sqrt (q s)) with (- sqrt (q s)) by ring. rewrite excess_opp, Rabs_Ropp. apply Rabs_right. lra. }
  replace (excess (e * sqrt (q s)) - 0 - 0 * (s - t)) with (excess (e * sqrt (q s))) by ring. rewrite size.
  apply Rle_trans with (1 := proj2 (excess_cubic _ root)).
  destruct (Rle_dec (q s) 0) as [none|some]; [rewrite sqrt_neg_0 by exact none; nra|].
  rewrite sqrt_sqrt by lra. rewrite zero, Rminus_0_r, Rabs_right in rate by lra.
  apply Rle_trans with (eps / K * (K * (s - t))).
  - apply Rmult_le_compat; lra.
  - right. field. lra.
Qed.

(** ** The first turn as a difference of two angles *)

Section Turn.
  Variables (e x y : R).
  Hypothesis side : e = 1 \/ e = -1.
  Hypothesis far : 1 <= outer_sq x y.
  Let P := outer_sq x y.
  Let c := sqrt (P - 1).
  Let A := left_turn x y (e * c) 0.

  Lemma turned_from : P * cos A = y + 1 + e * c * x /\ P * sin A = e * c * (y + 1) - x.
  Proof.
    assert (cc : c * c = P - 1) by (apply sqrt_sqrt; unfold P; lra).
    assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring).
    assert (equal : (y + 1) * (y + 1) + x * x = 1 * 1 + e * c * (e * c)).
    { replace (e * c * (e * c)) with (e * e * (c * c)) by ring. rewrite ee, cc. unfold P, outer_sq. ring. }
    destruct (turn_of_equals _ _ _ _ equal) as [ec es].
    replace ((y + 1) * (y + 1) + x * x) with P in * by (unfold P, outer_sq; ring).
    replace (rotation _ _) with A in ec, es by (unfold A, left_turn; f_equal; ring). lra.
  Qed.

  (** The direction of the start, seen from the centre of the turn and measured from the upright. *)
  Lemma direction_of_start : sqrt P * cos (atan (e * c) - A) = y + 1 /\ sqrt P * sin (atan (e * c) - A) = x.
  Proof.
    destruct turned_from as [ec es].
    assert (cc : c * c = P - 1) by (apply sqrt_sqrt; unfold P; lra).
    assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring).
    assert (rpos : 0 < sqrt P) by (apply sqrt_lt_R0; unfold P; lra).
    assert (rr : sqrt P * sqrt P = P) by (apply sqrt_sqrt; unfold P; lra).
    assert (square : e * c * (e * c) = P - 1) by (transitivity (e * e * (c * c)); [ring|rewrite ee, cc; ring]).
    assert (under : 1 + Rsqr (e * c) = P) by (unfold Rsqr; rewrite square; ring).
    rewrite cos_minus, sin_minus, cos_atan, sin_atan, under. set (r := sqrt P) in *. clearbody r.
    set (f := e * c) in *. clearbody f. assert (Ppos : 0 < P) by (unfold P; lra).
    split; apply Rmult_eq_reg_l with P; try lra.
    - transitivity (P * cos A + f * (P * sin A)); [field; lra|]. rewrite ec, es.
      transitivity ((y + 1) * (1 + f * f)); [ring|]. rewrite square. ring.
    - transitivity (f * (P * cos A) - P * sin A); [field; lra|]. rewrite ec, es.
      transitivity (x * (1 + f * f)); [ring|]. rewrite square. ring.
  Qed.

  (** The turn, where the angle at which the start is seen gives one from 0 to a whole one. *)
  Lemma turn_is alpha : sqrt P * cos alpha = y + 1 -> sqrt P * sin alpha = x ->
    0 <= atan (e * c) - alpha < 2 * PI -> A = atan (e * c) - alpha.
  Proof.
    intros ec es inside. destruct direction_of_start as [fc fs].
    assert (rpos : 0 < sqrt P) by (apply sqrt_lt_R0; unfold P; lra).
    assert (bounds : 0 <= A < 2 * PI) by apply rotation_bounds.
    assert (same : atan (e * c) - A = alpha); [|lra]. apply same_angle.
    - apply Rabs_lt_between. lra.
    - apply Rmult_eq_reg_l with (sqrt P); lra.
    - apply Rmult_eq_reg_l with (sqrt P); lra.
  Qed.

  (** Whatever angle the start is seen at, the turn is no less than that gives, if that is less than a whole turn. *)
  Lemma turn_at_least alpha : sqrt P * cos alpha = y + 1 -> sqrt P * sin alpha = x ->
    atan (e * c) - alpha < 2 * PI -> atan (e * c) - alpha <= A.
  Proof.
    intros ec es below. assert (bounds : 0 <= A < 2 * PI) by apply rotation_bounds.
    destruct (Rle_dec 0 (atan (e * c) - alpha)) as [inside|negative]; [|lra].
    rewrite (turn_is alpha ec es (conj inside below)). lra.
  Qed.
End Turn.

(** ** Which of two straight words is faster: across the axis *)

(** The direction of a start, seen from the centre of the turn, in [[0, 2 PI)], and as seen for a whole turn less. *)
Definition direction (x y : R) : R := rotation (y + 1) x.

Lemma direction_turns x y :
  sqrt (outer_sq x y) * cos (direction x y) = y + 1 /\ sqrt (outer_sq x y) * sin (direction x y) = x
  /\ sqrt (outer_sq x y) * cos (direction x y - 2 * PI) = y + 1
  /\ sqrt (outer_sq x y) * sin (direction x y - 2 * PI) = x.
Proof.
  destruct (rotation_turns (y + 1) x) as [ec es]. fold (direction x y) in ec, es.
  replace ((y + 1) * (y + 1) + x * x) with (outer_sq x y) in * by (unfold outer_sq; ring).
  rewrite cos_minus, sin_minus, cos_2PI, sin_2PI. lra.
Qed.

Lemma direction_right x y : 0 < outer_sq x y -> 0 <= x -> 0 <= direction x y <= PI.
Proof.
  intros off right. pose proof (rotation_bounds (y + 1) x) as bounds. fold (direction x y) in bounds.
  destruct (direction_turns x y) as (_ & es & _). pose proof (sqrt_lt_R0 _ off) as rpos.
  split; [lra|]. apply Rnot_lt_le. intros beyond. pose proof (sin_lt_0 (direction x y) beyond ltac:(lra)). nra.
Qed.

Lemma direction_left x y : 0 < outer_sq x y -> x < 0 -> PI < direction x y < 2 * PI.
Proof.
  intros off left. pose proof (rotation_bounds (y + 1) x) as bounds. fold (direction x y) in bounds.
  destruct (direction_turns x y) as (_ & es & _). pose proof (sqrt_lt_R0 _ off) as rpos.
  split; [|lra]. apply Rnot_le_lt. intros within. pose proof (sin_ge_0 (direction x y) ltac:(lra) within). nra.
Qed.

(** The end of a turn on the axis is seen at the arctangent of its abscissa. *)
Lemma direction_of_end P : 1 <= P -> let a := atan (sqrt (P - 1)) in sqrt P * cos a = 1 /\ 0 <= a < PI / 2.
Proof.
  intros far a. assert (cc := sqrt_sqrt (P - 1) ltac:(lra)). pose proof (sqrt_pos (P - 1)) as cpos.
  assert (rpos : 0 < sqrt P) by (apply sqrt_lt_R0; lra). unfold a. split.
  - rewrite cos_atan. replace (1 + Rsqr (sqrt (P - 1))) with P by (unfold Rsqr; lra). field. lra.
  - pose proof (atan_bound (sqrt (P - 1))). split; [|lra]. rewrite <- atan_0.
    destruct (Req_dec (sqrt (P - 1)) 0) as [-> | differ]; [lra|]. left. apply atan_increasing. lra.
Qed.

Lemma cos_reflected v : cos (2 * PI - v) = cos v.
Proof. rewrite cos_minus, cos_2PI, sin_2PI. ring. Qed.

Section Below.
  Variables x y : R.
  Hypothesis below : y < 0.
  Hypothesis far : 1 <= outer_sq x y.
  Let P := outer_sq x y.
  Let P' := outer_sq x (- y).
  Let alpha := direction x y.
  Let beta := direction x (- y).
  Let a := atan (sqrt (P - 1)).
  Let a' := atan (sqrt (P' - 1)).

  Lemma farther : P < P'.
  Proof. unfold P, P', outer_sq. nra. Qed.

  Lemma both_far : 1 <= P /\ 1 <= P'.
  Proof. pose proof farther. split; [exact far|]. unfold P in *. lra. Qed.

  Lemma excess_farther : excess (sqrt (P - 1)) <= excess (sqrt (P' - 1)).
  Proof. apply excess_grows, sqrt_le_1_alt. pose proof farther. lra. Qed.

  (** The start is lower than the end of a left turn, and higher than that of a right turn. *)
  Lemma lower : a < alpha /\ alpha < 2 * PI - a.
  Proof.
    pose proof PI_RGT_0. destruct (direction_turns x y) as (ec & es & _). fold P alpha in ec, es.
    destruct (direction_of_end P far) as [ea bounds]. fold a in ea, bounds.
    assert (rpos : 0 < sqrt P) by (apply sqrt_lt_R0; unfold P; lra).
    assert (lt : cos alpha < cos a) by (apply Rmult_lt_reg_l with (sqrt P); lra).
    pose proof (rotation_bounds (y + 1) x) as turn. fold (direction x y) alpha in turn.
    split; apply Rnot_le_lt; intros no.
    - assert (cos a <= cos alpha); [|lra]. apply cos_decr_1; lra.
    - rewrite <- cos_reflected in lt. assert (cos a <= cos (2 * PI - alpha)); [|lra]. apply cos_decr_1; lra.
  Qed.

  Lemma higher : beta < a' \/ 2 * PI - a' < beta.
  Proof.
    pose proof PI_RGT_0. pose proof farther. destruct both_far as [P1 P'1]. destruct (direction_turns x (- y)) as (ec & es & _). fold P' beta in ec, es.
    destruct (direction_of_end P' P'1) as [ea bounds]. fold a' in ea, bounds.
    assert (rpos : 0 < sqrt P') by (apply sqrt_lt_R0; lra).
    assert (gt : cos a' < cos beta) by (apply Rmult_lt_reg_l with (sqrt P'); lra).
    pose proof (rotation_bounds (- y + 1) x) as turn. fold (direction x (- y)) beta in turn.
    destruct (Rle_dec beta PI).
    - left. apply Rnot_le_lt. intros no. assert (cos beta <= cos a'); [|lra]. apply cos_decr_1; lra.
    - right. apply Rnot_le_lt. intros no. rewrite <- (cos_reflected beta) in gt.
      assert (cos (2 * PI - beta) <= cos a'); [|lra]. apply cos_decr_1; lra.
  Qed.

  (** Both directions lie on the same side, and that of the right turn is nearer to the upright. *)
  Lemma directions : (0 <= x /\ 0 <= beta < a' /\ beta <= alpha /\ alpha <= PI)
    \/ (x < 0 /\ PI < alpha /\ 2 * PI - a' < beta /\ alpha <= beta /\ beta < 2 * PI).
  Proof.
    pose proof PI_RGT_0. pose proof farther as wider. destruct both_far as [P1 P'1]. destruct (direction_turns x y) as (ec & es & _). fold P alpha in ec, es.
    destruct (direction_turns x (- y)) as (fc & fs & _). fold P' beta in fc, fs.
    assert (rpos : 0 < sqrt P) by (apply sqrt_lt_R0; lra).
    assert (r'pos : 0 < sqrt P') by (apply sqrt_lt_R0; lra).
    assert (cross : sqrt P * sqrt P' * sin (alpha - beta) = -2 * x * y).
    { rewrite sin_minus. transitivity (sqrt P * sin alpha * (sqrt P' * cos beta) - sqrt P * cos alpha * (sqrt P' * sin beta));
        [ring|]. rewrite ec, es, fc, fs. ring. }
    assert (both : 0 < sqrt P * sqrt P') by (apply Rmult_lt_0_compat; assumption).
    destruct (direction_of_end P' P'1) as [_ bounds]. fold a' in bounds.
    destruct (Rle_dec 0 x) as [right|left].
    - left. pose proof (direction_right x y ltac:(fold P; lra) right) as da. fold alpha in da.
      pose proof (direction_right x (- y) ltac:(fold P'; lra) right) as db. fold beta in db.
      destruct higher as [near|far_]; [|lra]. repeat split; try lra.
      apply Rnot_lt_le. intros no. pose proof (sin_lt_0_var (alpha - beta) ltac:(lra) ltac:(lra)). nra.
    - right. pose proof (direction_left x y ltac:(fold P; lra) ltac:(lra)) as da. fold alpha in da.
      pose proof (direction_left x (- y) ltac:(fold P'; lra) ltac:(lra)) as db. fold beta in db.
      destruct higher as [near|far_]; [lra|]. repeat split; try lra.
      apply Rnot_lt_le. intros no. pose proof (sin_gt_0 (alpha - beta) ltac:(lra) ltac:(lra)). nra.
  Qed.

  (** The first turn and the straight piece, up to a constant: to the left end of the axis L is faster, to the right R. *)
  Lemma to_left_end : left_to_axis (-1) x y <= left_to_axis (-1) x (- y).
  Proof.
    pose proof PI_RGT_0. pose proof farther as wider. destruct both_far as [P1 P'1]. pose proof excess_farther as more. pose proof lower as low.
    destruct (direction_turns x y) as (ec & es & fc & fs). destruct (direction_turns x (- y)) as (gc & gs & hc & hs).
    assert (minus : forall v, atan (-1 * v) = - atan v) by (intros v; replace (-1 * v) with (- v) by ring; apply atan_opp).
    pose proof (turn_is (-1) x y (or_intror eq_refl) far _ fc fs) as A. rewrite minus in A. fold P alpha a in A.
    pose proof (turn_at_least (-1) x (- y) (or_intror eq_refl) P'1) as B.
    rewrite minus in B. fold P' a' in B. destruct (direction_of_end P far) as [_ ba]. fold a in ba.
    unfold left_to_axis. fold P P'. unfold excess in more. fold a a' in more.
    assert (same : left_turn x y (-1 * sqrt (P - 1)) 0 = - a - (alpha - 2 * PI)).
    { apply A. lra. }
    rewrite same. destruct directions as [(right & db & ab & _)|(left & da & far_ & ab & db)].
    - specialize (B (beta - 2 * PI) hc hs). lra.
    - assert (deeper : sqrt P' * cos (beta - 2 * PI - 2 * PI) = - y + 1 /\ sqrt P' * sin (beta - 2 * PI - 2 * PI) = x).
      { rewrite (cos_minus (beta - 2 * PI)), (sin_minus (beta - 2 * PI)), cos_2PI, sin_2PI. fold P' beta in hc, hs. lra. }
      specialize (B (beta - 2 * PI - 2 * PI) (proj1 deeper) (proj2 deeper)). lra.
  Qed.

  Lemma to_right_end : left_to_axis 1 x (- y) <= left_to_axis 1 x y.
  Proof.
    pose proof PI_RGT_0. pose proof farther as wider. destruct both_far as [P1 P'1]. pose proof excess_farther as more. pose proof lower as low.
    destruct (direction_turns x y) as (ec & es & fc & fs). destruct (direction_turns x (- y)) as (gc & gs & hc & hs).
    pose proof (turn_at_least 1 x y (or_introl eq_refl) far _ fc fs) as A. rewrite Rmult_1_l in A. fold P alpha a in A.
    pose proof (turn_is 1 x (- y) (or_introl eq_refl) P'1) as B.
    rewrite Rmult_1_l in B. fold P' a' in B. unfold left_to_axis. fold P P'. rewrite !Rmult_1_l.
    unfold excess in more. fold a a' in more. specialize (A ltac:(lra)).
    destruct (direction_of_end P' P'1) as [_ ba']. fold a' in ba'. destruct (direction_of_end P P1) as [_ ba]. fold a in ba.
    destruct directions as [(right & db & ab & _)|(left & da & far_ & ab & db)].
    - rewrite (B beta gc gs) by lra. lra.
    - rewrite (B (beta - 2 * PI) hc hs) by lra. lra.
  Qed.
End Below.

(** Below the axis LSL takes no longer than RSL, and RSR no longer than LSR; above it is the other way round. *)
Theorem faster_below_the_axis rho x y : 1 <= rho -> y <= 0 ->
  (exists_at LSL rho x y -> time_of LSL rho x y <= time_of RSL rho x y)
  /\ (exists_at LSR rho x y -> time_of RSR rho x y <= time_of LSR rho x y).
Proof.
  intros wide low. assert (mirror : outer_sq x (- y) = range_sq x y) by (unfold outer_sq, range_sq; ring).
  assert (right : forall e, right_turn x y (e * sqrt (range_sq x y - 1)) 0 - e * sqrt (range_sq x y - 1) = left_to_axis e x (- y)).
  { intros e. unfold left_to_axis. rewrite mirror, mirrored_turn, Ropp_involutive, Ropp_0. reflexivity. }
  simpl. unfold lsl_exists, lsr_exists, lsl_time, rsl_time, lsr_time, rsr_time. cbv zeta.
  split.
  - intros far. assert (off : 1 <= outer_sq x y) by nra. pose proof (right (-1)) as R1.
    assert (less : left_to_axis (-1) x y <= left_to_axis (-1) x (- y)).
    { destruct (Req_dec y 0) as [-> | differ]; [rewrite Ropp_0; lra|]. apply to_left_end; [lra|exact off]. }
    rewrite <- R1 in less. unfold left_to_axis in less.
    replace (-1 * sqrt (range_sq x y - 1)) with (- sqrt (range_sq x y - 1)) in less by ring.
    replace (-1 * sqrt (outer_sq x y - 1)) with (- sqrt (outer_sq x y - 1)) in less by ring. lra.
  - intros (_ & off & _). pose proof (right 1) as R1.
    assert (less : left_to_axis 1 x (- y) <= left_to_axis 1 x y).
    { destruct (Req_dec y 0) as [-> | differ]; [rewrite Ropp_0; lra|]. apply to_right_end; [lra|exact off]. }
    rewrite <- R1 in less. unfold left_to_axis in less. rewrite !Rmult_1_l in less. lra.
Qed.

Theorem faster_above_the_axis rho x y : 1 <= rho -> 0 <= y ->
  (exists_at RSL rho x y -> time_of RSL rho x y <= time_of LSL rho x y)
  /\ (exists_at RSR rho x y -> time_of LSR rho x y <= time_of RSR rho x y).
Proof.
  intros wide up. destruct (faster_below_the_axis rho x (- y) wide ltac:(lra)) as [outer inner].
  assert (swap : outer_sq x (- y) = range_sq x y) by (unfold outer_sq, range_sq; ring).
  assert (back : range_sq x (- y) = outer_sq x y) by (unfold outer_sq, range_sq; ring).
  assert (turn : forall c, left_turn x (- y) c 0 = right_turn x y c 0)
    by (intros c; rewrite mirrored_turn, Ropp_involutive, Ropp_0; reflexivity).
  assert (turned : forall c, right_turn x (- y) c 0 = left_turn x y c 0)
    by (intros c; rewrite mirrored_turn, Ropp_0; reflexivity).
  simpl in *. unfold lsl_exists, rsl_exists, lsr_exists, rsr_exists, lsl_time, rsl_time, lsr_time, rsr_time in *.
  cbv zeta in *. rewrite swap, back, turn, turned in outer. rewrite swap, back, turn, turned in inner.
  split; assumption.
Qed.

(** ** On the edges: no straight word falls faster than time passes *)

(** To the right of a state, wherever it exists there, a time falls no faster than time passes. *)
Definition falls_slowly (T : R -> R -> R) (E : R -> R -> Prop) (x0 y0 : R) : Prop :=
  forall x y t u, x t = x0 -> y t = y0 -> moves x y t u -> forall eps, 0 < eps ->
    at_right t (fun s => E (x s) (y s) -> T x0 y0 + t - eps * (s - t) <= T (x s) (y s) + s).

Lemma rd_excess_of_root e q t q' : e = 1 \/ e = -1 -> 0 <= q t -> right_derive q t q' ->
  right_derive (fun s => excess (e * sqrt (q s))) t (e * (q' / 2 * sqrt (q t)) / (1 + q t)).
Proof.
  intros side nonneg rq. destruct (Req_dec (q t) 0) as [zero|differ].
  - rewrite zero, sqrt_0. replace (e * (q' / 2 * 0) / (1 + 0)) with 0 by field. exact (rd_excess_at_root e q t q' side zero rq).
  - assert (qpos : 0 < q t) by lra. pose proof (rd_scal e _ _ _ (rd_sqrt q t q' qpos rq)) as rr. simpl in rr.
    pose proof (rd_comp excess _ t _ _ (is_derive_excess _) rr) as rate. simpl in rate.
    match type of rate with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
      replace w with v; [exact rate|] end end.
    pose proof (sqrt_lt_R0 _ qpos) as rpos. assert (square := sqrt_sqrt (q t) ltac:(lra)). set (r := sqrt (q t)) in *.
    rewrite <- square. destruct side as [-> | ->]; field; split; nra.
Qed.

(** The first turn and the straight piece, up to a constant, on any edge. *)
Lemma left_to_axis_slowly e x0 y0 : e = 1 \/ e = -1 -> 1 <= outer_sq x0 y0 ->
  falls_slowly (left_to_axis e) (fun x y => 1 <= outer_sq x y) x0 y0.
Proof.
  intros side far x y t u <- <- mv eps epos. pose proof (rd_outer_sq _ _ _ _ mv) as rP. destruct mv as [ub [rx ry]].
  set (x0 := x t) in *. set (y0 := y t) in *. set (P := outer_sq x0 y0) in *.
  assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring).
  set (c := fun s => sqrt (outer_sq (x s) (y s) - 1)).
  set (A := left_turn x0 y0 (e * c t) 0).
  (* The direction of the start turns by [delta]. *)
  set (p := fun s => (y s + 1) * (y0 + 1) + x s * x0). set (n := fun s => x s * (y0 + 1) - (y s + 1) * x0).
  assert (p0 : p t = P) by (unfold p, P, outer_sq, x0, y0; ring).
  assert (n0 : n t = 0) by (unfold n, x0, y0; ring).
  pose proof (rd_plus _ _ _ _ _ ry (rd_const 1 t)) as ry1. simpl in ry1.
  assert (rp : right_derive p t (- (u * x0) * (y0 + 1) + (1 + u * y0) * x0)).
  { unfold p. pose proof (rd_plus _ _ _ _ _ (rd_scal (y0 + 1) _ _ _ ry1) (rd_scal x0 _ _ _ rx)) as r. simpl in r.
    apply (rd_ext (fun s => (y0 + 1) * (y s + 1) + x0 * x s)); [intros; ring|].
    match type of r with right_derive _ _ ?v => replace (- (u * x0) * (y0 + 1) + (1 + u * y0) * x0) with v; [exact r|] end.
    unfold x0, y0. ring. }
  assert (rn : right_derive n t ((1 + u * y0) * (y0 + 1) + u * x0 * x0)).
  { unfold n. pose proof (rd_minus _ _ _ _ _ (rd_scal (y0 + 1) _ _ _ rx) (rd_scal x0 _ _ _ ry1)) as r. simpl in r.
    apply (rd_ext (fun s => (y0 + 1) * x s - x0 * (y s + 1))); [intros; ring|].
    match type of r with right_derive _ _ ?v => replace ((1 + u * y0) * (y0 + 1) + u * x0 * x0) with v; [exact r|] end.
    unfold x0, y0. ring. }
  assert (off : off_cut (p t) (n t)) by (apply off_cut_intro; left; lra).
  pose proof (rd_angle_of p n t _ _ off rp rn) as rd. set (delta := fun s => angle_of (p s) (n s)) in *.
  rewrite p0, n0 in rd.
  assert (d0 : delta t = 0).
  { unfold delta, angle_of. rewrite n0. unfold Rdiv. rewrite Rmult_0_l, atan_0. ring. }
  pose proof (rd_minus _ _ _ _ _ rP (rd_const 1 t)) as rQ. simpl in rQ.
  assert (nonneg : 0 <= P - 1) by lra.
  pose proof (rd_excess_of_root e (fun s => outer_sq (x s) (y s) - 1) t _ side nonneg rQ) as re. simpl in re. fold x0 y0 P in re.
  change (sqrt (P - 1)) with (c t) in re.
  (* The smooth function that touches the time from below. *)
  set (F := fun s => - excess (e * c s) - delta s).
  assert (rF : right_derive F t (-1 + (1 - u) * axis_margin e x0 y0 / P)).
  { pose proof (rd_minus _ _ _ _ _ (rd_opp _ _ _ re) rd) as r. simpl in r. unfold F.
    match type of r with right_derive _ _ ?v => replace (-1 + (1 - u) * axis_margin e x0 y0 / P) with v; [exact r|] end.
    unfold axis_margin. fold P. change (sqrt (P - 1)) with (c t). fold x0.
    assert (plane : x0 * x0 = P - (y0 + 1) * (y0 + 1)) by (unfold P, outer_sq; ring).
    replace (1 + (P - 1)) with P by ring. clearbody P. generalize (c t). intros v.
    field [plane]. lra. }
  (* The turn is no less than its smooth continuation. *)
  assert (below : 0 <= A < 2 * PI) by apply rotation_bounds.
  destruct (direction_of_start e x0 y0 side far) as [ec es]. fold P in ec, es. change (sqrt (P - 1)) with (c t) in ec, es.
  fold A in ec, es. set (alpha := atan (e * c t) - A) in *.
  assert (cont : filterlim (fun s => atan (e * c s) - (alpha + delta s)) (at_right t) (locally (atan (e * c t) - (alpha + 0)))).
  { apply fl_minus.
    - apply (fl_derive atan (fun s => e * c s) _ _ (is_derive_atan _)). apply fl_scal.
      change (filterlim (fun s => sqrt (outer_sq (x s) (y s) - 1)) (at_right t) (locally (sqrt (P - 1)))). apply fl_sqrt; [exact nonneg|].
      exact (rd_right_continuous _ _ _ rQ).
    - apply fl_plus; [apply fl_const|]. rewrite <- d0. exact (rd_right_continuous _ _ _ rd). }
  assert (less : atan (e * c t) - (alpha + 0) < 2 * PI) by (unfold alpha; lra).
  pose proof (fl_below _ _ (2 * PI) less cont) as small.
  assert (away : at_right t (fun s => off_cut (p s) (n s))).
  { assert (pt : 0 < p t) by lra. pose proof (fl_above _ _ 0 pt (rd_right_continuous _ _ _ rp)) as pos. revert pos. apply filter_imp.
    intros s pos. apply off_cut_intro. left. exact pos. }
  pose proof (rd_slow F t ((1 - u) * axis_margin e x0 y0 / P)
    ltac:(apply Rmult_le_pos; [apply Rmult_le_pos; [lra|apply axis_margin_nonneg; assumption]|left; apply Rinv_0_lt_compat; lra])
    rF eps epos) as slow.
  generalize (filter_and _ _ small (filter_and _ _ away slow)). apply filter_imp. intros s (lt & off_s & le) far_s.
  assert (touch : atan (e * c s) - (alpha + delta s) <= left_turn (x s) (y s) (e * c s) 0).
  { destruct (cos_sin_angle_of _ _ off_s) as [gc gs]. fold (delta s) in gc, gs.
    assert (lengths : sqrt (p s * p s + n s * n s) = sqrt P * sqrt (outer_sq (x s) (y s))).
    { rewrite <- sqrt_mult by lra. f_equal. unfold p, n, P, outer_sq. ring. }
    rewrite lengths in gc, gs. assert (rr : sqrt P * sqrt P = P) by (apply sqrt_sqrt; lra).
    apply (turn_at_least e (x s) (y s) side far_s); [| |exact lt]; apply Rmult_eq_reg_l with (sqrt P * sqrt P); try (rewrite rr; lra).
    - rewrite cos_plus. transitivity (sqrt P * cos alpha * (sqrt P * sqrt (outer_sq (x s) (y s)) * cos (delta s))
        - sqrt P * sin alpha * (sqrt P * sqrt (outer_sq (x s) (y s)) * sin (delta s))); [ring|].
      rewrite ec, es, gc, gs, rr. unfold p, n, P, outer_sq. ring.
    - rewrite sin_plus. transitivity (sqrt P * sin alpha * (sqrt P * sqrt (outer_sq (x s) (y s)) * cos (delta s))
        + sqrt P * cos alpha * (sqrt P * sqrt (outer_sq (x s) (y s)) * sin (delta s))); [ring|].
      rewrite ec, es, gc, gs, rr. unfold p, n, P, outer_sq. ring. }
  unfold left_to_axis. fold P. change (sqrt (P - 1)) with (c t). change (sqrt (outer_sq (x s) (y s) - 1)) with (c s).
  fold A. unfold F, excess in le. rewrite d0 in le. unfold alpha in touch. lra.
Qed.

Lemma slowly_from (T U : R -> R -> R) (E E' : R -> R -> Prop) k x0 y0 : (forall x y, U x y = T x y + k) -> (forall x y, E' x y -> E x y) ->
  falls_slowly T E x0 y0 -> falls_slowly U E' x0 y0.
Proof.
  intros same narrower slow x y t u ex ey mv eps pos. generalize (slow x y t u ex ey mv eps pos). apply filter_imp.
  intros s le here. specialize (le (narrower _ _ here)). rewrite !same. lra.
Qed.

Lemma slowly_mirrored (T : R -> R -> R) (E : R -> R -> Prop) x0 y0 :
  falls_slowly T E x0 (- y0) -> falls_slowly (fun x y => T x (- y)) (fun x y => E x (- y)) x0 y0.
Proof.
  intros slow x y t u <- <- mv. exact (slow x (fun s => - y s) t (- u) eq_refl eq_refl (mirrored_moves _ _ _ _ mv)).
Qed.

Definition has_straight (w : word) : Prop := match w with LSL | RSL | LSR | RSR => True | _ => False end.

(** Wherever a word with a straight piece exists, edges included, no control makes its time fall faster than time passes. *)
Theorem straight_falls_slowly w rho x y : 1 <= rho -> has_straight w -> exists_at w rho x y ->
  falls_slowly (time_of w rho) (exists_at w rho) x y.
Proof.
  intros wide straight ex.
  assert (mirror : forall x y, outer_sq x (- y) = range_sq x y) by (intros; unfold outer_sq, range_sq; ring).
  set (XE := sqrt (rho * (rho + 2))). set (XI := sqrt (rho * (rho - 2))).
  destruct w; simpl in *; try contradiction.
  - unfold lsl_exists in ex. apply (slowly_from (left_to_axis (-1)) _ (fun x y => 1 <= outer_sq x y) _
      (left_turn (- XE) 0 0 rho - XE)); [| |apply left_to_axis_slowly; [right; reflexivity|nra]].
    + intros a b. unfold lsl_time, left_to_axis. fold XE.
      replace (-1 * sqrt (outer_sq a b - 1)) with (- sqrt (outer_sq a b - 1)) by ring. ring.
    + unfold lsl_exists. intros; nra.
  - unfold rsl_exists in ex. apply (slowly_from (fun x y => left_to_axis (-1) x (- y)) _ (fun x y => 1 <= outer_sq x (- y)) _
      (left_turn (- XE) 0 0 rho - XE));
      [| |apply (slowly_mirrored (left_to_axis (-1)) (fun x y => 1 <= outer_sq x y)), left_to_axis_slowly;
        [right; reflexivity|rewrite mirror; nra]].
    + intros a b. unfold rsl_time, left_to_axis. fold XE. rewrite mirror, (mirrored_turn a (- b)), Ropp_involutive, Ropp_0.
      replace (-1 * sqrt (range_sq a b - 1)) with (- sqrt (range_sq a b - 1)) by ring. ring.
    + unfold rsl_exists. intros a b there. rewrite mirror. nra.
  - destruct ex as (two & off & _). apply (slowly_from (left_to_axis 1) _ (fun x y => 1 <= outer_sq x y) _
      (right_turn XI 0 0 rho + XI)); [| |apply left_to_axis_slowly; [left; reflexivity|exact off]].
    + intros a b. unfold lsr_time, left_to_axis. fold XI. rewrite Rmult_1_l. ring.
    + unfold lsr_exists. intros a b (_ & there & _). exact there.
  - destruct ex as (two & off & _). apply (slowly_from (fun x y => left_to_axis 1 x (- y)) _ (fun x y => 1 <= outer_sq x (- y)) _
      (right_turn XI 0 0 rho + XI));
      [| |apply (slowly_mirrored (left_to_axis 1) (fun x y => 1 <= outer_sq x y)), left_to_axis_slowly;
        [left; reflexivity|rewrite mirror; exact off]].
    + intros a b. unfold rsr_time, left_to_axis. fold XI. rewrite mirror, (mirrored_turn a (- b)), Ropp_involutive, Ropp_0, Rmult_1_l. ring.
    + unfold rsr_exists. intros a b (_ & there & _). rewrite mirror. exact there.
Qed.
