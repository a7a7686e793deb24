(** The least time of the synthesis, and which formula gives it near a state. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst.
Open Scope R_scope.

(** The states from which a left turn is optimal: within the last circle, left of the switching curve. *)
Definition left_first (x y : R) : Prop := outer_sq x y < 4 /\ x <= curve_x (outer_sq x y).

Lemma left_first_dec x y : {left_first x y} + {~ left_first x y}.
Proof.
  unfold left_first. destruct (Rlt_dec (outer_sq x y) 4) as [lt|no]; [|right; tauto].
  destruct (Rle_dec x (curve_x (outer_sq x y))) as [le|no]; [left|right]; tauto.
Qed.

(** The least time from a state of the upper half plane to [(0, 1)]. *)
Definition least_time_up (x y : R) : R :=
  if Req_EM_T (range_sq x y) 0 then 0
  else if Rle_dec 4 (range_sq x y) then time_rsl x y
  else if left_first_dec x y then time_lrl x y
  else time_rl x y.

(** The least time onto the circle, in either direction: to [(0, 1)] or [(0, -1)]. *)
Definition least_time (x y : R) : R := least_time_up x (Rabs y).

(** ** Values *)

Lemma at_target x y : range_sq x y = 0 -> x = 0 /\ y = 1.
Proof.
  unfold range_sq. intros zero. pose proof (pow2_ge_0 x). pose proof (pow2_ge_0 (y - 1)).
  assert (x = 0) by (apply Rsqr_0_uniq; unfold Rsqr; lra).
  assert (y - 1 = 0) by (apply Rsqr_0_uniq; unfold Rsqr; lra). split; lra.
Qed.

Lemma outer_range x y : outer_sq x y = range_sq x y + 4 * y.
Proof. unfold outer_sq, range_sq. ring. Qed.


(** Where both are flown, at the distance 2 from the target, RSL is RL. *)
Lemma times_at_two x y : range_sq x y = 4 -> time_rsl x y = time_rl x y.
Proof.
  intros two. unfold time_rsl, time_rl, range. rewrite two.
  replace (4 - 1) with 3 by ring.
  replace 4 with (2 * 2) at 1 by ring. rewrite sqrt_square by lra.
  replace (2 / 4) with (sin (PI / 6)) by (rewrite sin_PI6; field).
  pose proof PI_RGT_0. rewrite asin_sin by lra.
  replace (/ sqrt 3) with (tan (PI / 6)) by (rewrite tan_PI6; unfold Rdiv; ring).
  rewrite atan_tan by lra. field.
Qed.

Lemma bearing_bounds x y : - (2 * PI / 3) < PI / 3 + bearing x y < 4 * PI / 3.
Proof. pose proof (angle_of_bounds (ahead x y) (aside x y)). unfold bearing. lra. Qed.

(** The angle of a state on the right is at most a quarter turn from the horizontal. *)
Lemma angle_right x y : off_axis x y -> 0 <= x -> - (PI / 2) <= PI / 3 + bearing x y <= PI / 2.
Proof.
  intros off right. destruct (polar x y off) as [px _]. pose proof (off_axis_range x y off).
  pose proof (bearing_bounds x y) as bounds. pose proof PI_RGT_0. set (th := PI / 3 + bearing x y) in *.
  assert (nonneg : 0 <= cos th) by nra.
  split; apply Rnot_lt_le; intros beyond.
  - assert (cos (- th) < 0) by (apply cos_lt_0; lra). rewrite cos_neg in H1. lra.
  - assert (cos th < 0) by (apply cos_lt_0; lra). lra.
Qed.

(** A right turn to an angle [d] below the horizontal has no negative duration from a state that is no lower. *)
Lemma rotation_nonneg x y d : off_axis x y -> 0 <= d <= PI / 2 -> - (range x y * sin d) <= y - 1 ->
  PI / 3 + bearing x y <= PI + d.
Proof.
  intros off db high. destruct (polar x y off) as [_ py]. pose proof (off_axis_range x y off).
  pose proof (bearing_bounds x y) as bounds. pose proof PI_RGT_0. set (th := PI / 3 + bearing x y) in *.
  apply Rnot_lt_le. intros beyond.
  assert (lower : sin th < sin (PI + d)) by (apply sin_decreasing_1; lra).
  replace (sin (PI + d)) with (- sin d) in lower by (rewrite Rplus_comm, neg_sin; ring). nra.
Qed.

Lemma asin_quarter x y : range_sq x y <= 16 -> sin (asin (range x y / 4)) = range x y / 4
  /\ 0 <= asin (range x y / 4) <= PI / 2.
Proof.
  intros near. pose proof (range_range x y). assert (0 <= range x y) by apply sqrt_pos.
  assert (range x y <= 4) by nra.
  assert (sd : sin (asin (range x y / 4)) = range x y / 4) by (apply sin_asin; lra).
  pose proof (asin_bound (range x y / 4)). split; [exact sd|]. split; [|lra]. apply Rnot_lt_le. intros neg.
  pose proof PI_RGT_0. assert (sin (asin (range x y / 4)) < 0) by (apply sin_lt_0_var; lra). lra.
Qed.

(** The states where RL is flown: not at the target, within 2 of it, and not those where LRL is. *)
Lemma off_axis_outside x y : 0 <= y -> range_sq x y <> 0 -> range_sq x y <= 4 -> 4 <= outer_sq x y -> off_axis x y.
Proof.
  intros up other near beyond. rewrite outer_range in beyond.
  destruct (Rle_dec 0 x) as [right|left].
  - apply off_axis_right; [exact right|]. destruct (Req_dec y 1) as [->|differ]; [left|right; exact differ].
    destruct (Req_dec x 0) as [->|differ]; [|lra]. exfalso. apply other. unfold range_sq. ring.
  - apply off_cut_intro. right. unfold aside. intros zero.
    assert (Y : y - 1 = sqrt 3 * x) by lra. pose proof sqrt3_sq. pose proof sqrt3_bounds.
    unfold range_sq in *. rewrite Y in *. replace y with (1 + sqrt 3 * x) in * by lra.
    replace (sqrt 3 * x * (sqrt 3 * x)) with (sqrt 3 * sqrt 3 * (x * x)) in * by ring. rewrite sqrt3_sq in *. nra.
Qed.

Lemma off_axis_curve x y : 0 <= y -> outer_sq x y < 4 -> curve_x (outer_sq x y) <= x -> off_axis x y.
Proof.
  intros up inside beyond. destruct (facts x y up inside) as (_ & mpos & cpos & _). unfold curve_x in beyond.
  assert (0 <= x) by nra. apply off_axis_right; [assumption|].
  destruct (Req_dec y 1) as [->|differ]; [left|right; exact differ].
  destruct (Req_dec x 0) as [->|differ]; [|lra]. exfalso. unfold outer_sq in inside. lra.
Qed.

Lemma time_rl_nonneg x y : 0 <= y -> range_sq x y <> 0 -> range_sq x y <= 4 -> ~ left_first x y -> 0 <= time_rl x y.
Proof.
  intros up other near right. unfold time_rl. destruct (asin_quarter x y ltac:(lra)) as [sd db].
  set (d := asin (range x y / 4)) in *.
  assert (PI / 3 + bearing x y <= PI + d); [|lra].
  destruct (Rlt_dec (outer_sq x y) 4) as [inside|beyond].
  - assert (beyond : curve_x (outer_sq x y) <= x) by (unfold left_first in right; apply Rnot_lt_le; intros lt; apply right; lra).
    pose proof (off_axis_curve x y up inside beyond) as off.
    destruct (facts x y up inside) as (_ & mpos & cpos & _). unfold curve_x in beyond.
    pose proof (angle_right x y off ltac:(nra)). pose proof PI_RGT_0. lra.
  - pose proof (off_axis_outside x y up other near ltac:(lra)) as off.
    apply rotation_nonneg; [exact off|exact db|]. rewrite sd. pose proof (range_range x y).
    rewrite outer_range in beyond. nra.
Qed.

Lemma time_rsl_nonneg x y : 4 <= range_sq x y -> 0 <= time_rsl x y.
Proof.
  intros far. unfold time_rsl. pose proof (bearing_bounds x y).
  assert (sqrt 3 <= sqrt (range_sq x y - 1)) by (apply sqrt_le_1_alt; lra).
  assert (0 < sqrt (range_sq x y - 1)) by (apply sqrt_lt_R0; lra).
  assert (0 < atan (/ sqrt (range_sq x y - 1))).
  { rewrite <- atan_0. apply atan_increasing. apply Rinv_0_lt_compat. assumption. }
  lra.
Qed.

Lemma time_lrl_at_least x y : 0 <= y -> outer_sq x y < 4 -> PI / 2 < time_lrl x y.
Proof.
  intros up inside. pose proof (arcs_at_least x y up inside). unfold time_lrl. rewrite outer_angle_above by lra.
  pose proof (atan_bound (x / (y + 1))). lra.
Qed.

Lemma least_time_up_nonneg x y : 0 <= y -> 0 <= least_time_up x y.
Proof.
  intros up. unfold least_time_up. destruct (Req_EM_T _ _) as [_|other]; [lra|].
  destruct (Rle_dec 4 _) as [far|near]; [apply time_rsl_nonneg, far|].
  destruct (left_first_dec x y) as [[inside _]|right].
  - pose proof (time_lrl_at_least x y up inside). pose proof PI_RGT_0. lra.
  - apply time_rl_nonneg; [exact up|exact other|lra|exact right].
Qed.

(** On the last arc itself RL is the left arc alone, at most a sixth of a turn, and a quarter turn is a bound. *)
Lemma time_rl_on_last_arc x y : 0 <= y -> range_sq x y <> 0 -> range_sq x y <= 4 -> outer_sq x y = 4 -> x < 0 ->
  time_rl x y <= PI / 2.
Proof.
  intros up other near on left. pose proof (off_axis_outside x y up other near ltac:(lra)) as off.
  destruct (polar x y off) as [px py]. pose proof (off_axis_range x y off) as rpos. pose proof (range_range x y) as rr.
  pose proof (bearing_bounds x y) as bounds. pose proof PI_RGT_0. destruct (asin_quarter x y ltac:(lra)) as [sd db].
  unfold time_rl. set (d := asin (range x y / 4)) in *. rewrite outer_range in on.
  set (th := PI / 3 + bearing x y) in *. set (r := range x y) in *.
  assert (r2 : r <= 2) by nra.
  assert (d6 : d <= PI / 6).
  { apply Rnot_lt_le. intros large. assert (sin (PI / 6) < sin d) by (apply sin_increasing_1; lra).
    rewrite sin_PI6 in H0. lra. }
  assert (cneg : cos th < 0) by nra.
  assert (sth : sin th = - (r / 4)) by (apply Rmult_eq_reg_l with r; [rewrite py; nra|lra]).
  assert (PI <= th); [|unfold th in *; lra].
  apply Rnot_lt_le. intros before.
  destruct (Rlt_dec 0 th) as [pos|neg].
  - pose proof (sin_gt_0 th pos before). lra.
  - assert (th < - (PI / 2)).
    { apply Rnot_le_lt. intros ge. pose proof (cos_ge_0 th ge ltac:(lra)). lra. }
    (* then the state would be between 240 and 270 degrees, too low for the last arc *)
    assert (sin (- th) > sin (2 * (PI / 3))).
    { apply sin_decreasing_1; lra. }
    rewrite sin_2PI3, sin_neg in H1. pose proof sqrt3_bounds. nra.
Qed.
