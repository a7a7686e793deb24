(** Maneuvers that turn right first, at [R = 1], in the upper half of the reduced plane: RSL and RL.

    The right turn is about [(0, 1)], which is also the target; the state is seen from there, at the distance
    [range] and the angle [PI / 3 + bearing], so that the cut of the angle lies where another maneuver is faster. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles.
Open Scope R_scope.

Definition range_sq (x y : R) : R := x * x + (y - 1) * (y - 1).
Definition range (x y : R) : R := sqrt (range_sq x y).
Definition ahead (x y : R) : R := x / 2 + sqrt 3 / 2 * (y - 1).
Definition aside (x y : R) : R := - (sqrt 3 / 2 * x) + (y - 1) / 2.
Definition bearing (x y : R) : R := angle_of (ahead x y) (aside x y).
Definition off_axis (x y : R) : Prop := off_cut (ahead x y) (aside x y).

(** RL: right to the circle of radius 2 about [(0, -1)], where the angle is [PI + asin (range / 4)]; then left. *)
Definition time_rl (x y : R) : R := 2 * PI / 3 - bearing x y + 3 * asin (range x y / 4).

(** RSL: right to the point [(-c, 0)], straight to [(- sqrt 3, 0)], left for [PI / 3]. *)
Definition time_rsl (x y : R) : R :=
  let c := sqrt (range_sq x y - 1) in 2 * PI / 3 - bearing x y + atan (/ c) + c - sqrt 3 + PI / 3.

(** A state moves at the time [t] under the control [u]. *)
Definition moves (x y : R -> R) (t u : R) : Prop :=
  -1 <= u <= 1 /\ right_derive x t (1 + u * y t) /\ right_derive y t (- (u * x t)).

Lemma sqrt3_sq : sqrt 3 * sqrt 3 = 3.
Proof. apply sqrt_sqrt. lra. Qed.

Lemma sqrt3_bounds : 1.7 < sqrt 3 < 1.8.
Proof. pose proof sqrt3_sq. pose proof (sqrt_pos 3). split; nra. Qed.

Lemma ahead_aside x y : ahead x y * ahead x y + aside x y * aside x y = range_sq x y.
Proof.
  unfold ahead, aside, range_sq.
  transitivity ((1 + sqrt 3 * sqrt 3) / 4 * (x * x + (y - 1) * (y - 1))); [field|rewrite sqrt3_sq; field].
Qed.

Lemma range_sq_nonneg x y : 0 <= range_sq x y.
Proof. unfold range_sq. pose proof (pow2_ge_0 x). pose proof (pow2_ge_0 (y - 1)). lra. Qed.

Lemma range_range x y : range x y * range x y = range_sq x y.
Proof. apply sqrt_sqrt, range_sq_nonneg. Qed.

Lemma off_axis_range x y : off_axis x y -> 0 < range x y.
Proof. intros off. pose proof (off_cut_length _ _ off) as pos. rewrite ahead_aside in pos. exact pos. Qed.

(** The state in polar coordinates about the target. *)
Lemma polar x y : off_axis x y ->
  range x y * cos (PI / 3 + bearing x y) = x /\ range x y * sin (PI / 3 + bearing x y) = y - 1.
Proof.
  intros off. destruct (cos_sin_angle_of _ _ off) as [ec es]. rewrite ahead_aside in ec, es.
  fold (range x y) in ec, es. fold (bearing x y) in ec, es.
  rewrite cos_plus, sin_plus, cos_PI3, sin_PI3. unfold ahead in ec. unfold aside in es. pose proof sqrt3_sq. split.
  - replace (range x y * (1 / 2 * cos (bearing x y) - sqrt 3 / 2 * sin (bearing x y)))
      with (1 / 2 * (range x y * cos (bearing x y)) - sqrt 3 / 2 * (range x y * sin (bearing x y))) by ring.
    rewrite ec, es. transitivity ((1 + sqrt 3 * sqrt 3) / 4 * x); [field|rewrite sqrt3_sq; field].
  - replace (range x y * (sqrt 3 / 2 * cos (bearing x y) + 1 / 2 * sin (bearing x y)))
      with (sqrt 3 / 2 * (range x y * cos (bearing x y)) + 1 / 2 * (range x y * sin (bearing x y))) by ring.
    rewrite ec, es. transitivity ((1 + sqrt 3 * sqrt 3) / 4 * (y - 1)); [field|rewrite sqrt3_sq; field].
Qed.

Lemma rd_range_sq x y t u : moves x y t u ->
  right_derive (fun s => range_sq (x s) (y s)) t (2 * (1 + u) * x t).
Proof.
  intros [_ [rx ry]]. replace (2 * (1 + u) * x t)
    with (2 * x t * (1 + u * y t) + 2 * (y t - 1) * (- (u * x t) - 0)) by ring.
  apply (rd_plus (fun s => x s * x s) (fun s => (y s - 1) * (y s - 1))); [exact (rd_square _ _ _ rx)|].
  apply (rd_square (fun s => y s - 1)), rd_minus; [exact ry|apply rd_const].
Qed.

Lemma rd_bearing x y t u : moves x y t u -> off_axis (x t) (y t) ->
  right_derive (fun s => bearing (x s) (y s)) t
    (1 - (1 + u) * (x t * x t + y t * y t - y t) / range_sq (x t) (y t)).
Proof.
  intros [_ [rx ry]] off.
  assert (ra : right_derive (fun s => ahead (x s) (y s)) t ((1 + u * y t) / 2 + sqrt 3 / 2 * (- (u * x t)))).
  { apply (rd_ext (fun s => / 2 * x s + sqrt 3 / 2 * (y s - 1))); [intros; unfold ahead; field|].
    replace ((1 + u * y t) / 2 + sqrt 3 / 2 * (- (u * x t)))
      with (/ 2 * (1 + u * y t) + sqrt 3 / 2 * (- (u * x t) - 0)) by field.
    apply rd_plus; apply rd_scal; [exact rx|]. apply rd_minus; [exact ry|apply rd_const]. }
  assert (rb : right_derive (fun s => aside (x s) (y s)) t (- (sqrt 3 / 2) * (1 + u * y t) + (- (u * x t)) / 2)).
  { apply (rd_ext (fun s => - (sqrt 3 / 2) * x s + / 2 * (y s - 1))); [intros; unfold aside; field|].
    replace (- (sqrt 3 / 2) * (1 + u * y t) + (- (u * x t)) / 2)
      with (- (sqrt 3 / 2) * (1 + u * y t) + / 2 * (- (u * x t) - 0)) by field.
    apply rd_plus; apply rd_scal; [exact rx|]. apply rd_minus; [exact ry|apply rd_const]. }
  pose proof (rd_angle_of _ _ t _ _ off ra rb) as rr. simpl in rr. rewrite ahead_aside in rr.
  assert (moment : forall c d, ahead (x t) (y t) * (- (sqrt 3 / 2) * c + d / 2)
      - aside (x t) (y t) * (c / 2 + sqrt 3 / 2 * d) = x t * d - (y t - 1) * c).
  { intros c d. unfold ahead, aside.
    transitivity ((1 + sqrt 3 * sqrt 3) / 4 * (x t * d - (y t - 1) * c)); [field|rewrite sqrt3_sq; field]. }
  rewrite moment in rr.
  match type of rr with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rr|] end end.
  pose proof (off_axis_range _ _ off). pose proof (range_range (x t) (y t)).
  assert (0 < range_sq (x t) (y t)) by nra.
  apply Rmult_eq_reg_r with (range_sq (x t) (y t)); [|lra]. field_simplify; [|lra|lra].
  unfold range_sq. ring.
Qed.

(** ** RL *)

(** The sign that decides whether RL is optimal to first order: that of the switching function. *)
Definition rl_margin (x y : R) : R :=
  3 * range x y * x + (x * x + y * y - y) * sqrt (16 - range_sq x y).

Lemma is_derive_asin v : -1 < v < 1 -> is_derive asin v (/ sqrt (1 - v * v)).
Proof.
  intros inside. apply is_derive_Reals. pose proof (derive_pt_asin v inside) as slope.
  apply derive_pt_eq_1 in slope. unfold Rsqr, Rdiv in slope. rewrite Rmult_1_l in slope. exact slope.
Qed.

Lemma rd_time_rl x y t u : moves x y t u -> off_axis (x t) (y t) -> range (x t) (y t) < 4 ->
  right_derive (fun s => time_rl (x s) (y s)) t
    (- 1 + (1 + u) * rl_margin (x t) (y t) / (range_sq (x t) (y t) * sqrt (16 - range_sq (x t) (y t)))).
Proof.
  intros mv off near. pose proof (off_axis_range _ _ off) as rpos. pose proof (range_range (x t) (y t)) as rr.
  assert (qpos : 0 < range_sq (x t) (y t)) by nra.
  pose proof (rd_bearing _ _ _ _ mv off) as rb.
  pose proof (rd_sqrt _ t _ qpos (rd_range_sq _ _ _ _ mv)) as rg.
  pose proof (rd_scal (/ 4) _ _ _ rg) as rq. simpl in rq.
  assert (inside : -1 < / 4 * sqrt (range_sq (x t) (y t)) < 1) by (fold (range (x t) (y t)); lra).
  pose proof (rd_comp asin (fun s => / 4 * sqrt (range_sq (x s) (y s))) t _ _ (is_derive_asin _ inside) rq) as ra.
  simpl in ra.
  pose proof (rd_plus _ _ _ _ _ (rd_minus _ _ _ _ _ (rd_const (2 * PI / 3) t) rb) (rd_scal 3 _ _ _ ra)) as rt.
  simpl in rt.
  apply (rd_ext _ (fun s => time_rl (x s) (y s))) in rt.
  2:{ intros s _. unfold time_rl, range. do 3 f_equal. field. }
  match type of rt with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rt|] end end.
  fold (range (x t) (y t)). set (r := range (x t) (y t)) in *. set (q := range_sq (x t) (y t)) in *.
  assert (root : sqrt (1 - / 4 * r * (/ 4 * r)) = sqrt (16 - q) / 4).
  { apply sqrt_lem_1; [nra|apply Rmult_le_pos; [apply sqrt_pos|lra]|].
    replace (sqrt (16 - q) / 4 * (sqrt (16 - q) / 4)) with (sqrt (16 - q) * sqrt (16 - q) / 16) by field.
    rewrite sqrt_sqrt by nra. lra. }
  rewrite root. unfold rl_margin. fold q. fold r.
  assert (0 < sqrt (16 - q)) by (apply sqrt_lt_R0; nra). set (w := sqrt (16 - q)) in *.
  rewrite <- rr. field. split; lra.
Qed.

(** ** RSL *)

Definition rsl_margin (x y : R) : R := x * sqrt (range_sq x y - 1) + (x * x + y * y - y).

Lemma rd_time_rsl x y t u : moves x y t u -> off_axis (x t) (y t) -> 1 < range_sq (x t) (y t) ->
  right_derive (fun s => time_rsl (x s) (y s)) t (- 1 + (1 + u) * rsl_margin (x t) (y t) / range_sq (x t) (y t)).
Proof.
  intros mv off far.
  pose proof (rd_bearing _ _ _ _ mv off) as rb.
  pose proof (rd_minus _ _ _ _ _ (rd_range_sq _ _ _ _ mv) (rd_const 1 t)) as rq. simpl in rq.
  pose proof (rd_sqrt (fun s => range_sq (x s) (y s) - 1) t _ ltac:(lra) rq) as rc. simpl in rc.
  assert (cpos : 0 < sqrt (range_sq (x t) (y t) - 1)) by (apply sqrt_lt_R0; lra).
  assert (cc : sqrt (range_sq (x t) (y t) - 1) * sqrt (range_sq (x t) (y t) - 1) = range_sq (x t) (y t) - 1)
    by (apply sqrt_sqrt; lra).
  pose proof (rd_div (fun _ => 1) (fun s => sqrt (range_sq (x s) (y s) - 1)) t _ _ (Rgt_not_eq _ _ cpos)
    (rd_const 1 t) rc) as ri. simpl in ri.
  pose proof (rd_atan _ _ _ ri) as ra. simpl in ra.
  pose proof (rd_plus _ _ _ _ _ (rd_minus _ _ _ _ _ (rd_const (2 * PI / 3 - sqrt 3 + PI / 3) t) rb)
    (rd_plus _ _ _ _ _ ra rc)) as rt. simpl in rt.
  apply (rd_ext _ (fun s => time_rsl (x s) (y s))) in rt.
  2:{ intros s _. unfold time_rsl. replace (1 / sqrt (range_sq (x s) (y s) - 1))
        with (/ sqrt (range_sq (x s) (y s) - 1)) by (unfold Rdiv; ring). ring. }
  match type of rt with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rt|] end end.
  unfold rsl_margin. set (c := sqrt (range_sq (x t) (y t) - 1)) in *.
  set (q := range_sq (x t) (y t)) in *. replace q with (c * c + 1) by lra. field.
  repeat split; nra.
Qed.

(** In the upper half plane RSL cannot be improved to first order. *)
Lemma rsl_margin_nonneg x y : 0 <= y -> 1 <= range_sq x y -> 0 <= rsl_margin x y.
Proof.
  intros up far. unfold rsl_margin. pose proof (sqrt_pos (range_sq x y - 1)) as cpos.
  assert (cc := sqrt_sqrt (range_sq x y - 1) ltac:(lra)).
  set (c := sqrt (range_sq x y - 1)) in *. unfold range_sq in cc.
  replace (x * x + y * y - y) with (c * c + y) by nra.
  destruct (Rle_dec 0 (x + c)) as [ok|left]; [nra|].
  apply Rnot_lt_le. intros neg.
  assert (squares : (c * c + y) * (c * c + y) < (x * c) * (x * c)) by nra.
  assert (x * x = c * c + 2 * y - y * y) by nra. nra.
Qed.

(** Beyond the last circle RL cannot be improved to first order. *)
Lemma rl_margin_outside x y :
  4 <= x * x + (y + 1) * (y + 1) -> range_sq x y <= 4 -> 0 <= rl_margin x y.
Proof.
  intros beyond near. unfold rl_margin. pose proof (range_range x y) as rr.
  pose proof (sqrt_pos (range_sq x y)) as rpos. fold (range x y) in rpos.
  pose proof (sqrt_pos (16 - range_sq x y)) as wpos.
  assert (ww := sqrt_sqrt (16 - range_sq x y) ltac:(lra)).
  set (r := range x y) in *. set (w := sqrt (16 - range_sq x y)) in *.
  assert (xx : x * x = range_sq x y - (y - 1) * (y - 1)) by (unfold range_sq; ring).
  set (q := range_sq x y) in *. set (Y := y - 1) in *. replace y with (Y + 1) in * by (unfold Y; ring).
  assert (qpos : 0 <= q) by nra.
  replace (x * x + (Y + 1) * (Y + 1) - (Y + 1)) with (q + Y) by lra.
  assert (outer : 0 <= q + 4 * Y) by nra.
  assert (inner : 0 <= (4 + 2 * q) * Y + q * (7 - q)) by nra.
  assert (along : 0 <= q + Y) by lra.
  destruct (Rle_dec 0 x) as [ok|left].
  - assert (0 <= (q + Y) * w) by (apply Rmult_le_pos; assumption).
    assert (0 <= r * x) by (apply Rmult_le_pos; assumption). lra.
  - apply Rnot_lt_le. intros neg.
    assert (pos : 0 <= (q + Y) * w) by (apply Rmult_le_pos; assumption).
    assert (squares : (q + Y) * w * ((q + Y) * w) < 3 * r * x * (3 * r * x)) by nra.
    replace ((q + Y) * w * ((q + Y) * w)) with ((q + Y) * (q + Y) * (w * w)) in squares by ring.
    replace (3 * r * x * (3 * r * x)) with (9 * (r * r) * (x * x)) in squares by ring.
    rewrite ww, rr, xx in squares.
    assert (0 <= (q + 4 * Y) * ((4 + 2 * q) * Y + q * (7 - q))) by (apply Rmult_le_pos; assumption).
    nra.
Qed.
