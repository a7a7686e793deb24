(** The margin of the words with a straight piece onto a circle of any radius: wherever they exist, no control makes their
    times fall faster than time passes. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Wider.
Open Scope R_scope.

Lemma rd_local f g t l : at_right t (fun s => f s = g s) -> f t = g t -> right_derive f t l -> right_derive g t l.
Proof.
  intros [[e epos] same] here rf eps pos. destruct (rf eps pos) as [d [dpos H]].
  pose proof (Rmin_l d e). pose proof (Rmin_r d e). exists (Rmin d e). split; [apply Rmin_pos; assumption|].
  intros s near. rewrite <- here, <- same; [apply H; lra| |lra]. change (Rabs (s - t) < e). apply Rabs_lt_between. lra.
Qed.

Lemma rotation_as_angle d c : off_cut (- d) (- c) -> PI + angle_of (- d) (- c) = rotation d c.
Proof.
  intros off. destruct (cos_sin_angle_of _ _ off) as [ec es]. pose proof (off_cut_length _ _ off) as pos.
  destruct (rotation_turns d c) as [fc fs]. pose proof (angle_of_bounds (- d) (- c)). pose proof (rotation_bounds d c).
  replace (- d * - d + - c * - c) with (d * d + c * c) in * by ring. set (r := sqrt (d * d + c * c)) in *.
  apply same_angle; [apply Rabs_lt_between; lra| |]; apply Rmult_eq_reg_l with r; try lra.
  - rewrite Rplus_comm, neg_cos. lra.
  - rewrite Rplus_comm, neg_sin. lra.
Qed.

(** A left turn to the point [(e c, 0)] of the axis, [e] being 1 or -1, and then straight, up to a constant. *)
Definition left_to_axis (e x y : R) : R :=
  let c := sqrt (outer_sq x y - 1) in left_turn x y (e * c) 0 - e * c.

(** Its switching function, up to a positive factor. *)
Definition axis_margin (e x y : R) : R := x * x + y * y + y - e * (x * sqrt (outer_sq x y - 1)).

Lemma axis_margin_nonneg e x y : e = 1 \/ e = -1 -> 1 <= outer_sq x y -> 0 <= axis_margin e x y.
Proof.
  intros side far. unfold axis_margin. assert (cc := sqrt_sqrt (outer_sq x y - 1) ltac:(lra)).
  set (c := sqrt (outer_sq x y - 1)) in *. unfold outer_sq in *.
  assert (low : 0 <= x * x + y * y + y) by (destruct (Rle_dec 0 y); nra).
  assert (square : (x * c) * (x * c) <= (x * x + y * y + y) * (x * x + y * y + y)).
  { pose proof (pow2_ge_0 (y * c)) as yc. pose proof (pow2_ge_0 y) as yy.
    replace ((y * c) ^ 2) with (y * y * (c * c)) in yc by ring.
    replace (x * c * (x * c)) with (x * x * (c * c)) by ring. rewrite cc in *. lra. }
  assert (- (x * x + y * y + y) <= x * c <= x * x + y * y + y) by (split; nra).
  destruct side as [-> | ->]; lra.
Qed.

Lemma rd_outer_sq x y t u : moves x y t u -> right_derive (fun s => outer_sq (x s) (y s)) t (2 * (1 - u) * x t).
Proof.
  intros [_ [rx ry]]. replace (2 * (1 - u) * x t)
    with (2 * x t * (1 + u * y t) + 2 * (y t + 1) * (- (u * x t) + 0)) by ring.
  apply (rd_plus (fun s => x s * x s) (fun s => (y s + 1) * (y s + 1))); [exact (rd_square _ _ _ rx)|].
  apply (rd_square (fun s => y s + 1)), rd_plus; [exact ry|apply rd_const].
Qed.

Lemma rd_left_to_axis e x y t u : e = 1 \/ e = -1 -> moves x y t u -> 1 < outer_sq (x t) (y t) ->
  ~ (x t = e * sqrt (outer_sq (x t) (y t) - 1) /\ y t = 0) ->
  right_derive (fun s => left_to_axis e (x s) (y s)) t
    (- 1 + (1 - u) * axis_margin e (x t) (y t) / outer_sq (x t) (y t)).
Proof.
  intros side mv far off. pose proof (rd_outer_sq _ _ _ _ mv) as rP. destruct mv as [ub [rx ry]].
  pose proof (rd_minus _ _ _ _ _ rP (rd_const 1 t)) as rQ. simpl in rQ.
  pose proof (rd_sqrt (fun s => outer_sq (x s) (y s) - 1) t _ ltac:(lra) rQ) as rc. simpl in rc.
  assert (cpos : 0 < sqrt (outer_sq (x t) (y t) - 1)) by (apply sqrt_lt_R0; lra).
  assert (cc := sqrt_sqrt (outer_sq (x t) (y t) - 1) ltac:(lra)).
  pose proof (rd_scal e _ _ _ rc) as re. simpl in re.
  pose proof (rd_plus _ _ _ _ _ ry (rd_const 1 t)) as ry1. simpl in ry1.
  pose proof (rd_opp _ _ _ (rd_plus _ _ _ _ _ (rd_mult _ _ _ _ _ rx re) (rd_scal (0 + 1) _ _ _ ry1))) as rp. simpl in rp.
  pose proof (rd_opp _ _ _ (rd_minus _ _ _ _ _ (rd_mult _ _ _ _ _ ry1 re) (rd_scal (0 + 1) _ _ _ rx))) as rn. simpl in rn.
  assert (inside : off_cut (- (x t * (e * sqrt (outer_sq (x t) (y t) - 1)) + (0 + 1) * (y t + 1)))
      (- ((y t + 1) * (e * sqrt (outer_sq (x t) (y t) - 1)) - (0 + 1) * x t))).
  { apply off_cut_intro. set (c := sqrt (outer_sq (x t) (y t) - 1)) in *.
    destruct (Req_dec ((y t + 1) * (e * c) - (0 + 1) * x t) 0) as [zero|differ]; [left|right; lra].
    assert (xe : x t = e * ((y t + 1) * c)) by lra. rewrite xe. unfold outer_sq in cc. rewrite xe in cc.
    assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring).
    assert (level : ((y t + 1) * (y t + 1) - 1) * (c * c + 1) = 0).
    { transitivity (e * ((y t + 1) * c) * (e * ((y t + 1) * c)) + (y t + 1) * (y t + 1) - 1 - c * c); [|lra].
      transitivity (e * e * ((y t + 1) * c * ((y t + 1) * c)) + (y t + 1) * (y t + 1) - 1 - c * c); [rewrite ee; ring|ring]. }
    destruct (Rmult_integral _ _ level) as [flat|no]; [|nra].
    assert (two : y t * (y t + 2) = 0) by lra. destruct (Rmult_integral _ _ two) as [y0|y2].
    - exfalso. apply off. split; [rewrite xe, y0; ring|exact y0].
    - replace (y t) with (-2) by lra.
      replace (- (e * ((-2 + 1) * c) * (e * c) + (0 + 1) * (-2 + 1))) with (e * e * (c * c) + 1) by ring. rewrite ee. nra. }
  pose proof (rd_angle_of _ _ t _ _ inside rp rn) as ra. simpl in ra.
  pose proof (rd_minus _ _ _ _ _ (rd_plus _ _ _ _ _ (rd_const PI t) ra) re) as rt. simpl in rt.
  assert (open : at_right t (fun s => off_cut (- (x s * (e * sqrt (outer_sq (x s) (y s) - 1)) + (0 + 1) * (y s + 1)))
      (- ((y s + 1) * (e * sqrt (outer_sq (x s) (y s) - 1)) - (0 + 1) * x s)))).
  { pose proof (rd_right_continuous _ _ _ rp) as lp. pose proof (rd_right_continuous _ _ _ rn) as ln.
    pose proof (off_cut_length _ _ inside) as pos. unfold off_cut in *.
    apply (fl_above _ _ 0 inside). apply fl_plus; [|exact lp].
    apply fl_sqrt; [|apply fl_plus; apply fl_mult; assumption].
    rewrite <- length_sq. apply Rle_0_sqr. }
  assert (same : forall s, off_cut (- (x s * (e * sqrt (outer_sq (x s) (y s) - 1)) + (0 + 1) * (y s + 1)))
      (- ((y s + 1) * (e * sqrt (outer_sq (x s) (y s) - 1)) - (0 + 1) * x s)) ->
    PI + angle_of (- (x s * (e * sqrt (outer_sq (x s) (y s) - 1)) + (0 + 1) * (y s + 1)))
      (- ((y s + 1) * (e * sqrt (outer_sq (x s) (y s) - 1)) - (0 + 1) * x s)) - e * sqrt (outer_sq (x s) (y s) - 1)
    = left_to_axis e (x s) (y s)).
  { intros s away. rewrite (rotation_as_angle _ _ away). unfold left_to_axis, left_turn. f_equal. f_equal; ring. }
  pose proof (rd_local _ _ t _ (filter_imp _ _ same open) (same t inside) rt) as rate.
  match type of rate with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rate|] end end.
  unfold axis_margin. set (c := sqrt (outer_sq (x t) (y t) - 1)) in *.
  assert (P : outer_sq (x t) (y t) = c * c + 1) by lra. rewrite P. unfold outer_sq in P.
  set (a := x t) in *. set (b := y t) in *.
  assert (aa : a * a = c * c - b * b - 2 * b) by lra.
  match goal with |- context [?n / (?p * ?p + ?q * ?q)] => replace (p * p + q * q) with ((c * c + 1) * (c * c + 1)) end.
  2:{ destruct side as [-> | ->]; ring [aa]. }
  destruct side as [-> | ->]; field [aa]; split; nra.
Qed.

Lemma mirrored_moves x y t u : moves x y t u -> moves x (fun s => - y s) t (- u).
Proof.
  intros [ub [rx ry]]. split; [lra|]. split.
  - replace (1 + - u * - y t) with (1 + u * y t) by ring. exact rx.
  - replace (- (- u * x t)) with (- - (u * x t)) by ring. apply rd_opp, ry.
Qed.

(** The word has a straight piece, and its first turn does not begin where it ends, nor has it the radius 1, with which it
    touches the axis at the centre: there the time of the word has no derivative. *)
Definition smooth_at (w : word) (x y : R) : Prop :=
  match w with
  | LSL | RSL => y <> 0 \/ 0 < x
  | LSR => outer_sq x y <> 1 /\ (y <> 0 \/ x < 0)
  | RSR => range_sq x y <> 1 /\ (y <> 0 \/ x < 0)
  | _ => False
  end.

Lemma not_on_axis_point e x y : e = 1 \/ e = -1 -> y <> 0 \/ e * x < 0 -> ~ (x = e * sqrt (outer_sq x y - 1) /\ y = 0).
Proof.
  intros side [off|other] [on flat]; [contradiction|]. pose proof (sqrt_pos (outer_sq x y - 1)).
  rewrite on in other. destruct side as [-> | ->]; lra.
Qed.

(** The rate of a time function along a motion, with the adjoint [psi] and the switching function [phi]: the
    Hamilton-Jacobi-Bellman inequality [psi1 + |phi| <= 1] holds, here as an equality. *)
Definition margin_holds (T : R -> R -> R) (x0 y0 : R) : Prop :=
  exists psi1 phi, psi1 + Rabs phi = 1 /\
    forall x y t u, x t = x0 -> y t = y0 -> moves x y t u ->
      right_derive (fun s => T (x s) (y s)) t (- (psi1 + u * phi)).

Lemma left_margin e k x0 y0 : e = 1 \/ e = -1 -> 1 < outer_sq x0 y0 -> y0 <> 0 \/ e * x0 < 0 ->
  margin_holds (fun x y => left_to_axis e x y + k) x0 y0.
Proof.
  intros side far off. set (M := axis_margin e x0 y0 / outer_sq x0 y0).
  assert (0 <= M).
  { apply Rmult_le_pos; [apply axis_margin_nonneg; [exact side|lra]|left; apply Rinv_0_lt_compat; lra]. }
  exists (1 - M), M. split; [rewrite Rabs_right by lra; ring|]. intros x y t u <- <- mv.
  pose proof (rd_left_to_axis e x y t u side mv far (not_on_axis_point _ _ _ side off)) as rate.
  replace (- (1 - M + u * M)) with (- 1 + (1 - u) * axis_margin e (x t) (y t) / outer_sq (x t) (y t) + 0)
    by (unfold M, Rdiv; ring).
  apply rd_plus; [exact rate|apply rd_const].
Qed.

Lemma right_margin T x0 y0 : margin_holds (fun x y => T x (- y)) x0 (- y0) -> margin_holds T x0 y0.
Proof.
  intros (psi1 & phi & hjb & rate). exists psi1, (- phi). rewrite Rabs_Ropp. split; [exact hjb|].
  intros x y t u <- <- mv. pose proof (rate _ _ t _ eq_refl eq_refl (mirrored_moves _ _ _ _ mv)) as rd. cbv beta in rd.
  replace (- (psi1 + u * - phi)) with (- (psi1 + - u * phi)) by ring.
  apply (rd_ext (fun s => T (x s) (- - y s))); [intros; rewrite Ropp_involutive; reflexivity|exact rd].
Qed.

Lemma margin_ext T U x0 y0 : (forall x y, T x y = U x y) -> margin_holds T x0 y0 -> margin_holds U x0 y0.
Proof.
  intros same (psi1 & phi & hjb & rate). exists psi1, phi. split; [exact hjb|]. intros x y t u ex ey mv.
  apply (rd_ext (fun s => T (x s) (y s))); [intros; apply same|exact (rate x y t u ex ey mv)].
Qed.

(** Wherever a word with a straight piece exists, and is smooth, no control makes its time fall faster than time passes. *)
Theorem straight_margin w rho x y : 1 <= rho -> exists_at w rho x y -> smooth_at w x y -> margin_holds (time_of w rho) x y.
Proof.
  intros wide ex smooth. assert (mirror : outer_sq x (- y) = range_sq x y) by (unfold outer_sq, range_sq; ring).
  set (XE := sqrt (rho * (rho + 2))). set (XI := sqrt (rho * (rho - 2))).
  destruct w; simpl in *; try contradiction.
  - apply (margin_ext (fun x y => left_to_axis (-1) x y + (left_turn (- XE) 0 0 rho - XE))).
    + intros a b. unfold lsl_time, left_to_axis. fold XE.
      replace (-1 * sqrt (outer_sq a b - 1)) with (- sqrt (outer_sq a b - 1)) by ring. ring.
    + unfold lsl_exists in ex. apply left_margin; [right; reflexivity|nra|]. destruct smooth; [left; assumption|right; lra].
  - apply right_margin, (margin_ext (fun x y => left_to_axis (-1) x y + (left_turn (- XE) 0 0 rho - XE))).
    + intros a b. unfold rsl_time, left_to_axis. fold XE. rewrite mirrored_turn.
      replace (range_sq a (- b)) with (outer_sq a b) by (unfold outer_sq, range_sq; ring). rewrite Ropp_0.
      replace (-1 * sqrt (outer_sq a b - 1)) with (- sqrt (outer_sq a b - 1)) by ring. ring.
    + unfold rsl_exists in ex. apply left_margin; [right; reflexivity|rewrite mirror; nra|].
      destruct smooth; [left; lra|right; lra].
  - destruct ex as (two & off & _), smooth as [no side].
    apply (margin_ext (fun x y => left_to_axis 1 x y + (right_turn XI 0 0 rho + XI))).
    + intros a b. unfold lsr_time, left_to_axis. fold XI. rewrite Rmult_1_l. ring.
    + apply left_margin; [left; reflexivity|lra|]. destruct side; [left; assumption|right; lra].
  - destruct ex as (two & off & _), smooth as [no side].
    apply right_margin, (margin_ext (fun x y => left_to_axis 1 x y + (right_turn XI 0 0 rho + XI))).
    + intros a b. unfold rsr_time, left_to_axis. fold XI. rewrite mirrored_turn.
      replace (range_sq a (- b)) with (outer_sq a b) by (unfold outer_sq, range_sq; ring). rewrite Ropp_0, Rmult_1_l. ring.
    + apply left_margin; [left; reflexivity|rewrite mirror; lra|]. destruct side; [left; lra|right; lra].
Qed.
