(** What the paper prints: its switching curve (23), and its two examples in numbers. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value.
Open Scope R_scope.

(** The switching curve is that of the paper, with the root over the whole difference. *)
Theorem curve_of_the_paper P : 1 <= P < 4 ->
  let x := curve_x P in let y := curve_y P in
  x * x = - (y * y) + 3 * y + 3 / 2 - sqrt (y * y + 9 * y + 9 / 4).
Proof.
  intros bounds x y. pose proof (s_of_proper P bounds) as ps. pose proof (proper_inside _ ps) as inside.
  pose proof (s_of_above P bounds) as above. pose proof (c_sq _ inside) as cc. pose proof (w_sq (s_of P)) as ww. pose proof (w_pos (s_of P)) as wp.
  destruct ps as [spos [_ below]]. unfold x, y, curve_x, curve_y, m_of in *. clear x y.
  set (s := s_of P) in *. set (c := c_of s) in *. set (w := w_of s) in *.
  assert (root : sqrt ((3 * s - w) * s * ((3 * s - w) * s) + 9 * ((3 * s - w) * s) + 9 / 4)
      = 3 * (s * w) - s * s - 3 / 2).
  { assert (sw : (s * w) * (s * w) = s * s * (s * s + 3)) by (rewrite <- ww; ring).
    assert (pos : 0 <= s * w) by nra.
    apply sqrt_lem_1; [|assert (9 / 8 <= s * w) by nra; nra|nra].
    replace ((3 * s - w) * s * ((3 * s - w) * s) + 9 * ((3 * s - w) * s) + 9 / 4)
      with (9 * (s * s) * (s * s) - 6 * (s * s) * (s * w) + (s * w) * (s * w) + 27 * (s * s) - 9 * (s * w) + 9 / 4) by ring.
    nra. }
  rewrite root. replace ((3 * s - w) * c * ((3 * s - w) * c)) with ((3 * s - w) * (3 * s - w) * (c * c)) by ring.
  rewrite cc. replace ((3 * s - w) * (3 * s - w)) with (9 * (s * s) - 6 * (s * w) + w * w) by ring. rewrite ww.
  replace ((3 * s - w) * s * ((3 * s - w) * s)) with (9 * (s * s) * (s * s) - 6 * (s * s) * (s * w) + s * s * (w * w)) by ring.
  rewrite ww. field.
Qed.

(** ** Numbers *)

Lemma asin_as_atan v : -1 < v < 1 -> asin v = atan (v / sqrt (1 - v * v)).
Proof. intros inside. rewrite asin_atan by exact inside. unfold Rsqr. reflexivity. Qed.

Ltac numbers := unfold time_rsl, time_rl, time_lrl, arcs, turn_to, outer_angle, bearing, angle_of, ahead, aside,
  curve_x, m_of, c_of, s_of, discriminant, w_of, range, range_sq, outer_sq.

(** Decides by intervals which maneuver is flown. *)
Ltac far := rewrite Rabs_right by lra; destruct (Req_EM_T _ _) as [no|_]; [exfalso; unfold range_sq in no; lra|];
  destruct (Rle_dec 4 _) as [_|no]; [|exfalso; apply no; unfold range_sq; lra].
Ltac near := rewrite Rabs_right by lra; destruct (Req_EM_T _ _) as [no|_]; [exfalso; unfold range_sq in no; lra|];
  destruct (Rle_dec 4 _) as [no|_]; [exfalso; unfold range_sq in no; lra|].

(** Example 1: from (4, 4), by RSL. *)
Theorem example_1 : 6.913575694780 <= least_time 4 4 <= 6.913575694781.
Proof. unfold least_time, least_time_up. far. numbers. split; interval with (i_prec 80). Qed.

(** Example 2: from (-0.53, 0.31), by LRL. *)
Theorem example_2 : 5.377867042802 <= least_time (- 0.53) 0.31 <= 5.377867042803.
Proof.
  unfold least_time, least_time_up. near.
  destruct (left_first_dec _ _) as [_|no].
  - unfold time_lrl, arcs. rewrite asin_as_atan.
    + numbers. split; interval with (i_prec 90).
    + apply proper_inside, s_of_proper. unfold outer_sq. lra.
  - exfalso. apply no. split; [unfold outer_sq; lra|]. numbers. interval.
Qed.

(** From (1, 0.5), right of the switching curve, by RL. *)
Theorem example_rl : 4.455086758522 <= least_time 1 0.5 <= 4.455086758523.
Proof.
  unfold least_time, least_time_up. near.
  destruct (left_first_dec _ _) as [[_ no]|_].
  - exfalso. apply Rle_not_lt in no. apply no. numbers. interval.
  - unfold time_rl. rewrite asin_as_atan; [|unfold range, range_sq; split; interval]. numbers. split; interval with (i_prec 80).
Qed.
