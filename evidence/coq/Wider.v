(** Wider circles, of any radius [rho >= 1]: the words of docs/theory.md, section 3, with their times in closed form, and
    that each of them is flown where it exists. So the least time is at most the least of theirs; that it is no less is
    proved for [rho = 1] only (Synthesis, Clockwise). *)

Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound Attained Synthesis Clockwise.
Import ListNotations.
Open Scope R_scope.

(** * Arcs *)

(** The angle in [[0, 2 PI)] of the vector [(d, c)] from its first axis; 0 for the vector 0. *)
Definition rotation (d c : R) : R :=
  let r := sqrt (d * d + c * c) in
  if Rle_dec r 0 then 0 else if Rlt_dec c 0 then 2 * PI - acos (d / r) else acos (d / r).

Lemma within_unit d c : 0 < sqrt (d * d + c * c) ->
  let v := d / sqrt (d * d + c * c) in
  -1 <= v <= 1 /\ 1 - v * v = (c / sqrt (d * d + c * c)) * (c / sqrt (d * d + c * c)).
Proof.
  intros pos v. pose proof (length_sq d c) as rr. unfold v. set (r := sqrt (d * d + c * c)) in *.
  assert (square : 1 - d / r * (d / r) = c / r * (c / r)).
  { apply Rmult_eq_reg_r with (r * r); [|nra]. field_simplify; [nra|lra|lra]. }
  split; [|exact square]. pose proof (pow2_ge_0 (c / r)). split; nra.
Qed.

Lemma rotation_bounds d c : 0 <= rotation d c < 2 * PI.
Proof.
  unfold rotation. pose proof PI_RGT_0. destruct (Rle_dec _ 0) as [_|no]; [lra|].
  destruct (within_unit d c ltac:(lra)) as [bounds square]. set (v := d / sqrt (d * d + c * c)) in *.
  pose proof (acos_bound v). destruct (Rlt_dec c 0) as [neg|_]; [|lra]. split; [lra|].
  assert (acos v <> 0); [|lra]. intros zero. assert (one : v = 1) by (rewrite <- (cos_acos v bounds), zero; apply cos_0).
  rewrite one in square. assert (0 < (c / sqrt (d * d + c * c)) * (c / sqrt (d * d + c * c))); [|lra].
  assert (0 < / sqrt (d * d + c * c)) by (apply Rinv_0_lt_compat; lra).
  assert (c / sqrt (d * d + c * c) < 0); [|nra]. unfold Rdiv. nra.
Qed.

Lemma rotation_turns d c :
  sqrt (d * d + c * c) * cos (rotation d c) = d /\ sqrt (d * d + c * c) * sin (rotation d c) = c.
Proof.
  unfold rotation. pose proof (sqrt_pos (d * d + c * c)) as nonneg. pose proof (length_sq d c) as rr.
  destruct (Rle_dec _ 0) as [zero|no].
  { assert (z : sqrt (d * d + c * c) = 0) by lra. rewrite z in *. split; nra. }
  destruct (within_unit d c ltac:(lra)) as [bounds square]. set (r := sqrt (d * d + c * c)) in *.
  assert (cv : r * cos (acos (d / r)) = d) by (rewrite cos_acos by exact bounds; field; lra).
  assert (sv : sin (acos (d / r)) = Rabs c / r).
  { rewrite sin_acos by exact bounds. unfold Rsqr. rewrite square.
    replace (c / r * (c / r)) with (Rabs c / r * (Rabs c / r)).
    - apply sqrt_square, Rmult_le_pos; [apply Rabs_pos|left; apply Rinv_0_lt_compat; lra].
    - replace (Rabs c / r * (Rabs c / r)) with (Rabs c * Rabs c / (r * r)) by (field; lra).
      rewrite <- Rabs_mult, Rabs_right by nra. field. lra. }
  destruct (Rlt_dec c 0) as [neg|nonn].
  - rewrite cos_minus, sin_minus, cos_2PI, sin_2PI, sv, Rabs_left by exact neg. split; [lra|]. field. lra.
  - rewrite sv, Rabs_right by lra. split; [exact cv|field; lra].
Qed.

(** From one point of a circle to another: the angle between them about its centre, [(0, 1)] or [(0, -1)]. *)
Definition right_turn (x0 y0 x1 y1 : R) : R :=
  rotation (x0 * x1 + (y0 - 1) * (y1 - 1)) (x0 * (y1 - 1) - (y0 - 1) * x1).
Definition left_turn (x0 y0 x1 y1 : R) : R :=
  rotation (x0 * x1 + (y0 + 1) * (y1 + 1)) ((y0 + 1) * x1 - x0 * (y1 + 1)).

Lemma turn_of_equals p n p1 n1 : p * p + n * n = p1 * p1 + n1 * n1 ->
  let t := rotation (p * p1 + n * n1) (p * n1 - n * p1) in
  (p * p + n * n) * cos t = p * p1 + n * n1 /\ (p * p + n * n) * sin t = p * n1 - n * p1.
Proof.
  intros equal t. destruct (rotation_turns (p * p1 + n * n1) (p * n1 - n * p1)) as [ec es]. fold t in ec, es.
  replace (sqrt _) with (p * p + n * n) in ec, es; [split; assumption|]. symmetry.
  replace ((p * p1 + n * n1) * (p * p1 + n * n1) + (p * n1 - n * p1) * (p * n1 - n * p1))
    with ((p * p + n * n) * (p1 * p1 + n1 * n1)) by ring.
  rewrite <- equal. apply sqrt_square. nra.
Qed.

Lemma right_arc x0 y0 x1 y1 : range_sq x0 y0 = range_sq x1 y1 -> reaches x0 y0 (right_turn x0 y0 x1 y1) x1 y1.
Proof.
  unfold range_sq, right_turn. intros equal. destruct (turn_of_equals _ _ _ _ equal) as [ec es].
  destruct (rotation_turns x0 (y0 - 1)) as [ac as_].
  pose proof (rotation_bounds (x0 * x1 + (y0 - 1) * (y1 - 1)) (x0 * (y1 - 1) - (y0 - 1) * x1)) as tb.
  set (t := rotation (x0 * x1 + (y0 - 1) * (y1 - 1)) (x0 * (y1 - 1) - (y0 - 1) * x1)) in *.
  pose proof (length_sq x0 (y0 - 1)) as rr.
  set (r := sqrt (x0 * x0 + (y0 - 1) * (y0 - 1))) in *. set (a := rotation x0 (y0 - 1)) in *.
  pose proof (flies_right r a (a + t) ltac:(lra)) as arc. rewrite cos_plus, sin_plus in arc.
  assert (ends : x0 * cos t - (y0 - 1) * sin t = x1 /\ (y0 - 1) * cos t + x0 * sin t = y1 - 1).
  { destruct (Req_dec (x0 * x0 + (y0 - 1) * (y0 - 1)) 0) as [zero|differ].
    - destruct (Rplus_sqr_eq_0 x0 (y0 - 1) zero) as [-> ->]. rewrite equal in zero.
      destruct (Rplus_sqr_eq_0 x1 (y1 - 1) zero) as [-> ->]. lra.
    - split; apply Rmult_eq_reg_l with (x0 * x0 + (y0 - 1) * (y0 - 1)); try exact differ.
      + transitivity (x0 * ((x0 * x0 + (y0 - 1) * (y0 - 1)) * cos t)
          - (y0 - 1) * ((x0 * x0 + (y0 - 1) * (y0 - 1)) * sin t)); [ring|].
        rewrite ec, es. ring.
      + transitivity ((y0 - 1) * ((x0 * x0 + (y0 - 1) * (y0 - 1)) * cos t)
          + x0 * ((x0 * x0 + (y0 - 1) * (y0 - 1)) * sin t)); [ring|].
        rewrite ec, es. ring. }
  destruct ends as [ex ey].
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ arc).
  - exact ac.
  - lra.
  - ring.
  - rewrite <- ex, <- as_ at 1. rewrite <- ac at 1. ring.
  - replace y1 with (1 + (y1 - 1)) by ring. rewrite <- ey, <- as_ at 1. rewrite <- ac at 1. ring.
Qed.

Lemma mirrored_turn x0 y0 x1 y1 : left_turn x0 y0 x1 y1 = right_turn x0 (- y0) x1 (- y1).
Proof. unfold left_turn, right_turn. f_equal; ring. Qed.

Lemma left_arc x0 y0 x1 y1 : outer_sq x0 y0 = outer_sq x1 y1 -> reaches x0 y0 (left_turn x0 y0 x1 y1) x1 y1.
Proof.
  intros equal. rewrite mirrored_turn, <- (Ropp_involutive y0) at 1. rewrite <- (Ropp_involutive y1) at 2.
  apply mirrored, right_arc. unfold outer_sq, range_sq in *. lra.
Qed.

(** The last arcs from the axis, as docs/theory.md has them. *)
Lemma last_left_arc rho : 1 <= rho -> left_turn (- sqrt (rho * (rho + 2))) 0 0 rho = acos (1 / (rho + 1)).
Proof.
  intros wide. assert (XX := sqrt_sqrt (rho * (rho + 2)) ltac:(nra)). pose proof (sqrt_pos (rho * (rho + 2))).
  set (X := sqrt (rho * (rho + 2))) in *. unfold left_turn.
  replace (- X * 0 + (0 + 1) * (rho + 1)) with (rho + 1) by ring.
  replace ((0 + 1) * 0 - - X * (rho + 1)) with (X * (rho + 1)) by ring.
  unfold rotation. replace (sqrt _) with ((rho + 1) * (rho + 1)).
  - destruct (Rle_dec _ 0); [nra|]. destruct (Rlt_dec _ 0); [nra|]. f_equal. field. lra.
  - symmetry. apply sqrt_lem_1; nra.
Qed.

Lemma last_right_arc rho : 2 <= rho -> right_turn (sqrt (rho * (rho - 2))) 0 0 rho = PI - acos (1 / (rho - 1)).
Proof.
  intros wide. assert (XX := sqrt_sqrt (rho * (rho - 2)) ltac:(nra)). pose proof (sqrt_pos (rho * (rho - 2))).
  set (X := sqrt (rho * (rho - 2))) in *. unfold right_turn.
  replace (X * 0 + (0 - 1) * (rho - 1)) with (- (rho - 1)) by ring.
  replace (X * (rho - 1) - (0 - 1) * 0) with (X * (rho - 1)) by ring.
  unfold rotation. replace (sqrt _) with ((rho - 1) * (rho - 1)).
  - destruct (Rle_dec _ 0); [nra|]. destruct (Rlt_dec _ 0); [nra|]. rewrite <- acos_opp. f_equal. field. lra.
  - symmetry. apply sqrt_lem_1; nra.
Qed.

(** * The words *)

(** LSL and RSL: onto the axis at [(-c, 0)], straight to [(-X, 0)], left. *)
Definition lsl_time (rho x y : R) : R :=
  let c := sqrt (outer_sq x y - 1) in let X := sqrt (rho * (rho + 2)) in
  left_turn x y (- c) 0 + (c - X) + left_turn (- X) 0 0 rho.
Definition lsl_exists (rho x y : R) : Prop := (rho + 1) * (rho + 1) <= outer_sq x y.

Definition rsl_time (rho x y : R) : R :=
  let c := sqrt (range_sq x y - 1) in let X := sqrt (rho * (rho + 2)) in
  right_turn x y (- c) 0 + (c - X) + left_turn (- X) 0 0 rho.
Definition rsl_exists (rho x y : R) : Prop := (rho + 1) * (rho + 1) <= range_sq x y.

(** LSR and RSR: onto the axis at [(c, 0)], straight to [(X, 0)], right. *)
Definition lsr_time (rho x y : R) : R :=
  let c := sqrt (outer_sq x y - 1) in let X := sqrt (rho * (rho - 2)) in
  left_turn x y c 0 + (X - c) + right_turn X 0 0 rho.
Definition lsr_exists (rho x y : R) : Prop := 2 <= rho /\ 1 <= outer_sq x y /\ outer_sq x y <= (rho - 1) * (rho - 1).

Definition rsr_time (rho x y : R) : R :=
  let c := sqrt (range_sq x y - 1) in let X := sqrt (rho * (rho - 2)) in
  right_turn x y c 0 + (X - c) + right_turn X 0 0 rho.
Definition rsr_exists (rho x y : R) : Prop := 2 <= rho /\ 1 <= range_sq x y /\ range_sq x y <= (rho - 1) * (rho - 1).

(** RL with the left ([side = -1]) or the right ([side = 1]) crossing of the circle of the first arc and the last circle. *)
Definition rl_time (side rho x y : R) : R :=
  let q := range_sq x y - (rho - 1) * (rho - 1) in let p := (rho + 3) * (rho + 3) - range_sq x y in
  let x1 := side * (sqrt (p * q) / 4) in let y1 := rho - q / 4 in
  right_turn x y x1 y1 + left_turn x1 y1 0 rho.
Definition rl_exists (rho x y : R) : Prop :=
  (rho - 1) * (rho - 1) <= range_sq x y /\ range_sq x y <= (rho + 3) * (rho + 3).

(** LR likewise, onto the circle of radius [rho - 1] about [(0, 1)]. *)
Definition lr_time (side rho x y : R) : R :=
  let q := (rho + 1) * (rho + 1) - outer_sq x y in let p := outer_sq x y - (rho - 3) * (rho - 3) in
  let x1 := side * (sqrt (p * q) / 4) in let y1 := rho - q / 4 in
  left_turn x y x1 y1 + right_turn x1 y1 0 rho.
Definition lr_exists (rho x y : R) : Prop :=
  1 < rho /\ (rho - 3) * (rho - 3) <= outer_sq x y /\ outer_sq x y <= (rho + 1) * (rho + 1).

(** LRL: left to [(m ya, ya)], right to [(- (m yb), yb)] on the last circle, left. *)
Definition lrl_h (rho x y : R) : R := (rho * (rho + 2) + outer_sq x y - 1) / 2.
Definition lrl_d (rho x y : R) : R := (rho * (rho + 2) - outer_sq x y + 1) / 4.
Definition lrl_under_root (rho x y : R) : R := lrl_h rho x y * lrl_h rho x y - 3 * lrl_d rho x y * lrl_d rho x y.
Definition lrl_time (rho x y : R) : R :=
  let d := lrl_d rho x y in let s := (lrl_h rho x y + sqrt (lrl_under_root rho x y)) / 3 in
  let m := sqrt (2 / s - 1) in let ya := (s - d) / 2 in let yb := (s + d) / 2 in
  left_turn x y (m * ya) ya + right_turn (m * ya) ya (- (m * yb)) yb + left_turn (- (m * yb)) yb 0 rho.
Definition lrl_exists (rho x y : R) : Prop :=
  rho <= 3 /\ outer_sq x y <= (3 - rho) * (3 - rho) /\ 0 <= lrl_under_root rho x y /\ lrl_h rho x y < 6.

Inductive word := LSL | RSL | LSR | RSR | RL_left | RL_right | LR_left | LR_right | LRL.

Definition exists_at (w : word) : R -> R -> R -> Prop :=
  match w with
  | LSL => lsl_exists | RSL => rsl_exists | LSR => lsr_exists | RSR => rsr_exists
  | RL_left | RL_right => rl_exists | LR_left | LR_right => lr_exists | LRL => lrl_exists
  end.

Definition time_of (w : word) : R -> R -> R -> R :=
  match w with
  | LSL => lsl_time | RSL => rsl_time | LSR => lsr_time | RSR => rsr_time
  | RL_left => rl_time (-1) | RL_right => rl_time 1 | LR_left => lr_time (-1) | LR_right => lr_time 1
  | LRL => lrl_time
  end.

(** ** Each is flown *)

Lemma on_target_left rho : outer_sq 0 rho = (rho + 1) * (rho + 1).
Proof. unfold outer_sq. ring. Qed.

Lemma on_target_right rho : range_sq 0 rho = (rho - 1) * (rho - 1).
Proof. unfold range_sq. ring. Qed.

Ltac fly := eapply reaches_trans; [eapply reaches_trans|].

Lemma external_flown rho : 1 <= rho -> let X := sqrt (rho * (rho + 2)) in reaches (- X) 0 (left_turn (- X) 0 0 rho) 0 rho.
Proof.
  intros wide X. apply left_arc. rewrite on_target_left. unfold outer_sq.
  assert (XX : X * X = rho * (rho + 2)) by (apply sqrt_sqrt; nra). lra.
Qed.

Lemma internal_flown rho : 2 <= rho -> let X := sqrt (rho * (rho - 2)) in reaches X 0 (right_turn X 0 0 rho) 0 rho.
Proof.
  intros wide X. apply right_arc. rewrite on_target_right. unfold range_sq.
  assert (XX : X * X = rho * (rho - 2)) by (apply sqrt_sqrt; nra). lra.
Qed.

Lemma onto_axis_left x y end_ : 1 <= outer_sq x y -> end_ * end_ = 1 ->
  let c := end_ * sqrt (outer_sq x y - 1) in reaches x y (left_turn x y c 0) c 0.
Proof.
  intros far unit c. apply left_arc. assert (cc := sqrt_sqrt (outer_sq x y - 1) ltac:(lra)).
  assert (c * c = outer_sq x y - 1).
  { rewrite <- cc. unfold c. transitivity (end_ * end_ * (sqrt (outer_sq x y - 1) * sqrt (outer_sq x y - 1))); [ring|].
    rewrite unit. ring. }
  unfold outer_sq in *. lra.
Qed.

Lemma onto_axis_right x y end_ : 1 <= range_sq x y -> end_ * end_ = 1 ->
  let c := end_ * sqrt (range_sq x y - 1) in reaches x y (right_turn x y c 0) c 0.
Proof.
  intros far unit c. apply right_arc. assert (cc := sqrt_sqrt (range_sq x y - 1) ltac:(lra)).
  assert (c * c = range_sq x y - 1).
  { rewrite <- cc. unfold c. transitivity (end_ * end_ * (sqrt (range_sq x y - 1) * sqrt (range_sq x y - 1))); [ring|].
    rewrite unit. ring. }
  unfold range_sq in *. lra.
Qed.

Lemma lsl_word_flown rho x y : 1 <= rho -> lsl_exists rho x y -> reaches x y (lsl_time rho x y) 0 rho.
Proof.
  unfold lsl_exists, lsl_time. intros wide far. pose proof (onto_axis_left x y (-1) ltac:(nra) ltac:(ring)) as first.
  cbv zeta in first. replace (-1 * sqrt (outer_sq x y - 1)) with (- sqrt (outer_sq x y - 1)) in first by ring.
  assert (le : sqrt (rho * (rho + 2)) <= sqrt (outer_sq x y - 1)) by (apply sqrt_le_1_alt; lra).
  pose proof (flies_straight (- sqrt (outer_sq x y - 1)) (- sqrt (rho * (rho + 2))) ltac:(lra)) as middle.
  fly; [exact first| |exact (external_flown rho wide)].
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ middle); try reflexivity. ring.
Qed.

Lemma rsl_word_flown rho x y : 1 <= rho -> rsl_exists rho x y -> reaches x y (rsl_time rho x y) 0 rho.
Proof.
  unfold rsl_exists, rsl_time. intros wide far. pose proof (onto_axis_right x y (-1) ltac:(nra) ltac:(ring)) as first.
  cbv zeta in first. replace (-1 * sqrt (range_sq x y - 1)) with (- sqrt (range_sq x y - 1)) in first by ring.
  assert (le : sqrt (rho * (rho + 2)) <= sqrt (range_sq x y - 1)) by (apply sqrt_le_1_alt; lra).
  pose proof (flies_straight (- sqrt (range_sq x y - 1)) (- sqrt (rho * (rho + 2))) ltac:(lra)) as middle.
  fly; [exact first| |exact (external_flown rho wide)].
  apply (reaches_same _ _ _ _ _ _ _ _ _ _ middle); try reflexivity. ring.
Qed.

Lemma lsr_word_flown rho x y : lsr_exists rho x y -> reaches x y (lsr_time rho x y) 0 rho.
Proof.
  unfold lsr_exists, lsr_time. intros (wide & off & near). pose proof (onto_axis_left x y 1 off ltac:(ring)) as first.
  cbv zeta in first. rewrite Rmult_1_l in first.
  assert (le : sqrt (outer_sq x y - 1) <= sqrt (rho * (rho - 2))) by (apply sqrt_le_1_alt; lra).
  fly; [exact first|exact (flies_straight _ _ le)|exact (internal_flown rho wide)].
Qed.

Lemma rsr_word_flown rho x y : rsr_exists rho x y -> reaches x y (rsr_time rho x y) 0 rho.
Proof.
  unfold rsr_exists, rsr_time. intros (wide & off & near). pose proof (onto_axis_right x y 1 off ltac:(ring)) as first.
  cbv zeta in first. rewrite Rmult_1_l in first.
  assert (le : sqrt (range_sq x y - 1) <= sqrt (rho * (rho - 2))) by (apply sqrt_le_1_alt; lra).
  fly; [exact first|exact (flies_straight _ _ le)|exact (internal_flown rho wide)].
Qed.

(** The square of a crossing's abscissa. *)
Lemma crossing side v : side * side = 1 -> 0 <= v -> side * (sqrt v / 4) * (side * (sqrt v / 4)) = v / 16.
Proof.
  intros unit nonneg. rewrite <- (sqrt_sqrt v nonneg) at 3.
  transitivity (side * side * (sqrt v * sqrt v / 16)); [field|]. rewrite unit. ring.
Qed.

Lemma rl_word_flown side rho x y : side * side = 1 -> rl_exists rho x y -> reaches x y (rl_time side rho x y) 0 rho.
Proof.
  unfold rl_exists, rl_time. intros unit [low high]. cbv zeta.
  set (q := range_sq x y - (rho - 1) * (rho - 1)). set (p := (rho + 3) * (rho + 3) - range_sq x y).
  assert (xx := crossing side (p * q) unit ltac:(apply Rmult_le_pos; unfold p, q; lra)).
  set (x1 := side * (sqrt (p * q) / 4)) in *.
  apply reaches_trans with x1 (rho - q / 4).
  - apply right_arc. unfold range_sq at 2. rewrite xx. unfold p, q. field.
  - apply left_arc. rewrite on_target_left. unfold outer_sq. rewrite xx. unfold p, q. field.
Qed.

Lemma lr_word_flown side rho x y : side * side = 1 -> lr_exists rho x y -> reaches x y (lr_time side rho x y) 0 rho.
Proof.
  unfold lr_exists, lr_time. intros unit (_ & low & high). cbv zeta.
  set (q := (rho + 1) * (rho + 1) - outer_sq x y). set (p := outer_sq x y - (rho - 3) * (rho - 3)).
  assert (xx := crossing side (p * q) unit ltac:(apply Rmult_le_pos; unfold p, q; lra)).
  set (x1 := side * (sqrt (p * q) / 4)) in *.
  apply reaches_trans with x1 (rho - q / 4).
  - apply left_arc. unfold outer_sq at 2. rewrite xx. unfold p, q. field.
  - apply right_arc. rewrite on_target_right. unfold range_sq. rewrite xx. unfold p, q. field.
Qed.

(** [0 < s <= 2], so that the switching points of LRL are real. *)
Lemma lrl_real rho x y : 1 <= rho -> lrl_exists rho x y ->
  let s := (lrl_h rho x y + sqrt (lrl_under_root rho x y)) / 3 in 0 < s <= 2.
Proof.
  intros wide (narrow & inside & real & low) s.
  pose proof (sqrt_pos (lrl_under_root rho x y)) as root. pose proof (sqrt_sqrt _ real) as square.
  assert (P : 0 <= outer_sq x y).
  { unfold outer_sq. pose proof (pow2_ge_0 x). pose proof (pow2_ge_0 (y + 1)). lra. }
  unfold s. set (w := sqrt (lrl_under_root rho x y)) in *. unfold lrl_under_root in square.
  assert (wider : 3 <= rho * (rho + 2)) by nra.
  assert (h1 : 1 <= lrl_h rho x y) by (unfold lrl_h; lra).
  split; [lra|].
  assert (product : 0 <= ((3 - rho) * (3 - rho) - outer_sq x y) * ((rho + 5) * (rho + 5) - outer_sq x y)).
  { apply Rmult_le_pos; nra. }
  assert (room : w * w <= (6 - lrl_h rho x y) * (6 - lrl_h rho x y)).
  { rewrite square. unfold lrl_h, lrl_d in *. nra. }
  assert (w <= 6 - lrl_h rho x y); [|lra]. apply Rsqr_incr_0; unfold Rsqr; lra.
Qed.

Lemma lrl_word_flown rho x y : 1 <= rho -> lrl_exists rho x y -> reaches x y (lrl_time rho x y) 0 rho.
Proof.
  intros wide ex. pose proof (lrl_real rho x y wide ex) as sb. destruct ex as (_ & _ & real & _). cbv zeta in sb.
  unfold lrl_time. pose proof (sqrt_sqrt _ real) as square. cbv zeta.
  set (w := sqrt (lrl_under_root rho x y)) in *. set (h := lrl_h rho x y) in *. set (d := lrl_d rho x y) in *.
  set (s := (h + w) / 3) in *.
  assert (root : 3 * s * s - 2 * h * s + d * d = 0).
  { unfold lrl_under_root in square. fold h d in square. unfold s.
    transitivity ((w * w - (h * h - 3 * d * d)) / 3); [field|]. rewrite square. field. }
  assert (inv : 1 <= 2 / s) by (apply Rmult_le_reg_r with s; [lra|]; field_simplify; lra).
  assert (mm := sqrt_sqrt (2 / s - 1) ltac:(lra)). set (m := sqrt (2 / s - 1)) in *.
  assert (ms : (m * m + 1) * s = 2) by (rewrite mm; field; lra).
  assert (outer_d : h - 2 * d = outer_sq x y - 1) by (unfold h, d, lrl_h, lrl_d; field).
  assert (last_d : h + 2 * d = rho * (rho + 2)) by (unfold h, d, lrl_h, lrl_d; field).
  assert (first_eq : (m * m + 1) * ((s - d) / 2 * ((s - d) / 2)) + (s - d) = h - 2 * d).
  { apply Rmult_eq_reg_r with s; [|lra].
    transitivity ((m * m + 1) * s * ((s - d) / 2 * ((s - d) / 2)) + (s - d) * s); [ring|]. rewrite ms. lra. }
  assert (last_eq : (m * m + 1) * ((s + d) / 2 * ((s + d) / 2)) + (s + d) = h + 2 * d).
  { apply Rmult_eq_reg_r with s; [|lra].
    transitivity ((m * m + 1) * s * ((s + d) / 2 * ((s + d) / 2)) + (s + d) * s); [ring|]. rewrite ms. lra. }
  fly.
  - apply left_arc. unfold outer_sq at 2. lra.
  - apply right_arc. unfold range_sq.
    assert (middle : (m * m + 1) * s * d = 2 * d) by (rewrite ms; reflexivity). lra.
  - apply left_arc. rewrite on_target_left. unfold outer_sq. lra.
Qed.

Theorem word_flown w rho x y : 1 <= rho -> exists_at w rho x y -> reaches x y (time_of w rho x y) 0 rho.
Proof.
  intros wide ex. destruct w; simpl in *.
  - apply lsl_word_flown; assumption.
  - apply rsl_word_flown; assumption.
  - apply lsr_word_flown, ex.
  - apply rsr_word_flown, ex.
  - apply rl_word_flown; [ring|exact ex].
  - apply rl_word_flown; [ring|exact ex].
  - apply lr_word_flown; [ring|exact ex].
  - apply lr_word_flown; [ring|exact ex].
  - apply lrl_word_flown; assumption.
Qed.

(** ** Some word exists *)

Lemma distances x y : let a := range x y in let b := sqrt (outer_sq x y) in 2 <= a + b /\ b <= a + 2.
Proof.
  intros a b. pose proof (range_range x y) as aa. fold a in aa.
  assert (Pn : 0 <= outer_sq x y) by (unfold outer_sq; pose proof (pow2_ge_0 x); pose proof (pow2_ge_0 (y + 1)); lra).
  pose proof (sqrt_sqrt _ Pn) as bb. fold b in bb.
  assert (a0 : 0 <= a) by apply sqrt_pos. assert (b0 : 0 <= b) by apply sqrt_pos.
  pose proof (pow2_ge_0 x). rewrite outer_range in bb. unfold range_sq in aa, bb.
  assert (1 - y <= a) by nra. assert (y - 1 <= a) by nra. assert (1 + y <= b) by nra. split; [lra|nra].
Qed.

Lemma some_word_exists rho x y : 1 <= rho -> exists w, exists_at w rho x y.
Proof.
  intros wide. destruct (distances x y) as [apart near]. pose proof (range_range x y) as aa.
  assert (Pn : 0 <= outer_sq x y) by (unfold outer_sq; pose proof (pow2_ge_0 x); pose proof (pow2_ge_0 (y + 1)); lra).
  pose proof (sqrt_sqrt _ Pn) as bb. pose proof (sqrt_pos (outer_sq x y)) as b0.
  assert (a0 : 0 <= range x y) by apply sqrt_pos. set (a := range x y) in *. set (b := sqrt (outer_sq x y)) in *.
  destruct (Rle_dec ((rho + 1) * (rho + 1)) (range_sq x y)) as [far|near_m]; [exists RSL; exact far|].
  destruct (Rle_dec ((rho - 1) * (rho - 1)) (range_sq x y)) as [mid|inner].
  { exists RL_left. split; [exact mid|nra]. }
  assert (ar : a < rho - 1) by nra.
  destruct (Rle_dec ((rho - 3) * (rho - 3)) (outer_sq x y)) as [lr|within].
  { exists LR_right. split; [lra|]. split; [exact lr|nra]. }
  assert (b < rho - 3) by nra.
  destruct (Rle_dec 1 a) as [rsr|close].
  - exists RSR. split; [lra|]. split; nra.
  - exists LSR. split; [lra|]. split; nra.
Qed.

(** * The least of the words *)

Lemma and_dec (A B : Prop) : {A} + {~ A} -> {B} + {~ B} -> {A /\ B} + {~ (A /\ B)}.
Proof. tauto. Qed.

Lemma exists_at_dec w rho x y : {exists_at w rho x y} + {~ exists_at w rho x y}.
Proof.
  destruct w; simpl; unfold lsl_exists, rsl_exists, lsr_exists, rsr_exists, rl_exists, lr_exists, lrl_exists;
    repeat apply and_dec; apply Rle_dec || apply Rlt_dec.
Qed.

(** The least time among those words of a list that exist at a state; none if there is no such word. *)
Fixpoint least_among (words : list word) (rho x y : R) : option R :=
  match words with
  | [] => None
  | w :: rest =>
      if exists_at_dec w rho x y
      then Some (match least_among rest rho x y with Some t => Rmin (time_of w rho x y) t | None => time_of w rho x y end)
      else least_among rest rho x y
  end.

Definition all_words : list word := [LSL; RSL; LSR; RSR; RL_left; RL_right; LR_left; LR_right; LRL].

(** The least of the words, clockwise; some word exists (some_word_exists), so that the 0 is never taken. *)
Definition least_of_words (rho x y : R) : R :=
  match least_among all_words rho x y with Some t => t | None => 0 end.

Lemma least_among_is_least words rho x y :
  match least_among words rho x y with
  | Some t => (exists w, exists_at w rho x y /\ t = time_of w rho x y)
      /\ (forall w, In w words -> exists_at w rho x y -> t <= time_of w rho x y)
  | None => forall w, In w words -> ~ exists_at w rho x y
  end.
Proof.
  induction words as [|v rest IH]; simpl; [tauto|].
  destruct (exists_at_dec v rho x y) as [ex|no].
  - destruct (least_among rest rho x y) as [t|].
    + destruct IH as [[w [exw ->]] below]. split.
      * destruct (Rle_dec (time_of v rho x y) (time_of w rho x y)) as [le|gt].
        -- exists v. rewrite Rmin_left by exact le. split; [exact ex|reflexivity].
        -- exists w. rewrite Rmin_right by lra. split; [exact exw|reflexivity].
      * intros z [<-|inside] exz; [apply Rmin_l|]. eapply Rle_trans; [apply Rmin_r|apply below; assumption].
    + split; [exists v; split; [exact ex|reflexivity]|].
      intros z [<-|inside] exz; [apply Rle_refl|]. exfalso. exact (IH z inside exz).
  - destruct (least_among rest rho x y) as [t|].
    + destruct IH as [some below]. split; [exact some|]. intros z [<-|inside] exz; [contradiction|]. apply below; assumption.
    + intros z [<-|inside]; [exact no|]. exact (IH z inside).
Qed.

Theorem least_of_words_is_least rho x y : 1 <= rho ->
  (exists w, exists_at w rho x y /\ least_of_words rho x y = time_of w rho x y)
  /\ (forall w, exists_at w rho x y -> least_of_words rho x y <= time_of w rho x y).
Proof.
  intros wide. pose proof (least_among_is_least all_words rho x y) as least. unfold least_of_words.
  assert (all : forall w, In w all_words) by (intros w; destruct w; simpl; tauto).
  destruct (least_among all_words rho x y) as [t|].
  - destruct least as [some below]. split; [exact some|]. intros w ex. exact (below w (all w) ex).
  - destruct (some_word_exists rho x y wide) as [w ex]. exfalso. exact (least w (all w) ex).
Qed.

Lemma least_of_words_attained rho x y : 1 <= rho -> reaches x y (least_of_words rho x y) 0 rho.
Proof.
  intros wide. destruct (least_of_words_is_least rho x y wide) as [[w [ex ->]] _]. apply word_flown; assumption.
Qed.

(** * The flights *)

Lemma flown_onto rho x y T X0 Y0 th0 : reaches (along X0 Y0 th0) (across X0 Y0 th0) T x y ->
  exists X Y th u, flight X Y th u T /\ X 0 = X0 /\ Y 0 = Y0 /\ th 0 = th0
    /\ (x = 0 -> y = rho -> on_clockwise_circle rho (X T) (Y T) (th T))
    /\ (x = 0 -> y = - rho -> on_circle rho (X T) (Y T) (th T)).
Proof.
  intros r. destruct (from_reduced X0 Y0 th0) as [backX backY].
  destruct (flown _ _ _ _ _ th0 r) as (X & Y & th & u & fl & eX & eY & eth & fX & fY).
  exists X, Y, th, u. split; [exact fl|]. split; [rewrite eX, <- backX; reflexivity|].
  split; [rewrite eY, <- backY; reflexivity|]. split; [exact eth|].
  rewrite fX, fY. split; intros -> ->; [split|right; split]; ring.
Qed.

(** From every state where a word exists, some flight onto the clockwise circle takes this word's time. *)
Theorem word_is_flown w rho X0 Y0 th0 :
  1 <= rho -> exists_at w rho (along X0 Y0 th0) (across X0 Y0 th0) ->
  exists X Y th u, flight X Y th u (time_of w rho (along X0 Y0 th0) (across X0 Y0 th0))
    /\ X 0 = X0 /\ Y 0 = Y0 /\ th 0 = th0
    /\ let T := time_of w rho (along X0 Y0 th0) (across X0 Y0 th0) in
       on_clockwise_circle rho (X T) (Y T) (th T).
Proof.
  intros wide ex. destruct (flown_onto rho _ _ _ _ _ _ (word_flown w rho _ _ wide ex))
    as (X & Y & th & u & fl & eX & eY & eth & on & _).
  exists X, Y, th, u. repeat (split; [assumption|]). apply on; reflexivity.
Qed.

(** From every state some flight onto the clockwise circle takes the least of the words. *)
Theorem least_of_words_is_flown rho X0 Y0 th0 : 1 <= rho ->
  exists X Y th u, flight X Y th u (least_of_words rho (along X0 Y0 th0) (across X0 Y0 th0))
    /\ X 0 = X0 /\ Y 0 = Y0 /\ th 0 = th0
    /\ let T := least_of_words rho (along X0 Y0 th0) (across X0 Y0 th0) in
       on_clockwise_circle rho (X T) (Y T) (th T).
Proof.
  intros wide. destruct (flown_onto rho _ _ _ _ _ _ (least_of_words_attained rho (along X0 Y0 th0) (across X0 Y0 th0) wide))
    as (X & Y & th & u & fl & eX & eY & eth & on & _).
  exists X, Y, th, u. repeat (split; [assumption|]). apply on; reflexivity.
Qed.

(** The same in either direction. *)
Theorem least_of_words_is_flown_either rho X0 Y0 th0 : 1 <= rho ->
  exists X Y th u, flight X Y th u (least_of_words rho (along X0 Y0 th0) (Rabs (across X0 Y0 th0)))
    /\ X 0 = X0 /\ Y 0 = Y0 /\ th 0 = th0
    /\ let T := least_of_words rho (along X0 Y0 th0) (Rabs (across X0 Y0 th0)) in
       on_circle rho (X T) (Y T) (th T).
Proof.
  intros wide. set (x0 := along X0 Y0 th0). set (y0 := across X0 Y0 th0).
  pose proof (least_of_words_attained rho x0 (Rabs y0) wide) as r.
  destruct (Rle_dec 0 y0) as [up|down].
  - rewrite Rabs_right in * by lra.
    destruct (flown_onto rho _ _ _ _ _ _ r) as (X & Y & th & u & fl & eX & eY & eth & on & _).
    exists X, Y, th, u. repeat (split; [assumption|]). left. apply on; reflexivity.
  - rewrite Rabs_left in * by lra. apply mirrored in r. rewrite Ropp_involutive in r.
    destruct (flown_onto rho _ _ _ _ _ _ r) as (X & Y & th & u & fl & eX & eY & eth & _ & on).
    exists X, Y, th, u. repeat (split; [assumption|]). apply on; reflexivity.
Qed.

(** At [rho = 1] the least of the words is no less than the least time, as no flight is faster. *)
Corollary least_time_at_most_least_of_words X0 Y0 th0 :
  least_time_clockwise (along X0 Y0 th0) (across X0 Y0 th0) <= least_of_words 1 (along X0 Y0 th0) (across X0 Y0 th0).
Proof.
  destruct (least_of_words_is_flown 1 X0 Y0 th0 (Rle_refl 1)) as (X & Y & th & u & fl & eX & eY & eth & on).
  apply (least_time_clockwise_is_least X0 Y0 th0 X Y th u); assumption.
Qed.
