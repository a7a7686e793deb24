(** The margin of RL and LR onto a circle of any radius, with either crossing: at which rate their times change along a
    motion, and that no control makes them fall faster than time passes where the margin is not negative. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Wider WiderMargin.
Open Scope R_scope.

(** The angle from one moving vector to another. *)
Lemma rd_rotation ax ay bx by_ t ax' ay' bx' by' :
  right_derive ax t ax' -> right_derive ay t ay' -> right_derive bx t bx' -> right_derive by_ t by' ->
  off_cut (- (ax t * bx t + ay t * by_ t)) (- (ax t * by_ t - ay t * bx t)) ->
  right_derive (fun s => rotation (ax s * bx s + ay s * by_ s) (ax s * by_ s - ay s * bx s)) t
    ((bx t * by' - by_ t * bx') / (bx t * bx t + by_ t * by_ t) - (ax t * ay' - ay t * ax') / (ax t * ax t + ay t * ay t)).
Proof.
  intros rax ray rbx rby inside.
  pose proof (rd_opp _ _ _ (rd_plus _ _ _ _ _ (rd_mult _ _ _ _ _ rax rbx) (rd_mult _ _ _ _ _ ray rby))) as rp. simpl in rp.
  pose proof (rd_opp _ _ _ (rd_minus _ _ _ _ _ (rd_mult _ _ _ _ _ rax rby) (rd_mult _ _ _ _ _ ray rbx))) as rn. simpl in rn.
  pose proof (rd_plus _ _ _ _ _ (rd_const PI t) (rd_angle_of _ _ t _ _ inside rp rn)) as rt. simpl in rt.
  set (p := fun s => - (ax s * bx s + ay s * by_ s)) in *. set (n := fun s => - (ax s * by_ s - ay s * bx s)) in *.
  assert (open : at_right t (fun s => off_cut (p s) (n s))).
  { pose proof (rd_right_continuous _ _ _ rp) as lp. pose proof (rd_right_continuous _ _ _ rn) as ln.
    pose proof (off_cut_length _ _ inside) as pos. unfold off_cut in *.
    apply (fl_above _ _ 0 inside). apply fl_plus; [|exact lp].
    apply fl_sqrt; [|apply fl_plus; apply fl_mult; assumption].
    rewrite <- length_sq. apply Rle_0_sqr. }
  assert (same : forall s, off_cut (p s) (n s) ->
    PI + angle_of (p s) (n s) = rotation (ax s * bx s + ay s * by_ s) (ax s * by_ s - ay s * bx s)).
  { intros s away. apply rotation_as_angle. exact away. }
  pose proof (rd_local _ _ t _ (filter_imp _ _ same open) (same t inside) rt) as rate.
  match type of rate with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w =>
    replace w with v; [exact rate|] end end.
  pose proof (off_cut_length _ _ inside) as pos. pose proof (length_sq (p t) (n t)) as square.
  assert (lengths : p t * p t + n t * n t = (ax t * ax t + ay t * ay t) * (bx t * bx t + by_ t * by_ t)) by (unfold p, n; ring).
  assert (nonzero : (ax t * ax t + ay t * ay t) * (bx t * bx t + by_ t * by_ t) <> 0) by (rewrite <- lengths; fold (p t) (n t) in pos; nra).
  match goal with |- context [?m / (?v * ?v + ?w * ?w)] =>
    match v with Ropp _ => replace (v * v + w * w)
      with ((ax t * ax t + ay t * ay t) * (bx t * bx t + by_ t * by_ t)) by ring end end.
  field. split; intros zero; apply nonzero; rewrite zero; ring.
Qed.

(** Two vectors of the same length that differ do not point the same way. *)
Lemma apart_off_cut ax ay bx by_ : ax * ax + ay * ay = bx * bx + by_ * by_ -> 0 < ax * ax + ay * ay -> ~ (ax = bx /\ ay = by_) ->
  off_cut (- (ax * bx + ay * by_)) (- (ax * by_ - ay * bx)).
Proof.
  intros equal pos apart. apply off_cut_intro. destruct (Req_dec (ax * by_ - ay * bx) 0) as [zero|differ]; [left|right; lra].
  set (q := ax * ax + ay * ay) in *. set (D := ax * bx + ay * by_).
  assert (sizes : D * D + (ax * by_ - ay * bx) * (ax * by_ - ay * bx) = q * q).
  { rewrite equal at 2. unfold D, q. ring. }
  rewrite zero in sizes. assert (either : (D - q) * (D + q) = 0) by (ring_simplify; lra).
  destruct (Rmult_integral _ _ either) as [aligned|opposite]; [exfalso|lra].
  apply apart. assert (none : (ax - bx) * (ax - bx) + (ay - by_) * (ay - by_) = 0).
  { transitivity (q + q - 2 * D); [|lra]. rewrite equal at 2. unfold D, q. ring. }
  destruct (Rplus_sqr_eq_0 _ _ none). lra.
Qed.

(** ** Right to a crossing, then left to the highest or lowest point of a circle about [(0, -1)] *)

(** The circle has the radius [k], the first arc about [(0, 1)] the square [q] of its radius; [e] is the side of the
    crossing, and the path ends at [(0, d k - 1)], [d] being 1 or -1. *)
Definition crossing_y (k q : R) : R := (k * k - q) / 4.
Definition crossing_x (e k q : R) : R := e * (sqrt (((k + 2) * (k + 2) - q) * (q - (k - 2) * (k - 2))) / 4).
Definition two_arcs (e k d x y : R) : R :=
  let q := range_sq x y in let x1 := crossing_x e k q in let y1 := crossing_y k q in
  right_turn x y x1 y1 + left_turn x1 y1 0 (d * k - 1).

(** The switching function, up to a positive factor: it vanishes where the start, the crossing and [(0, 1 - q)] are in line. *)
Definition crossing_margin (e k x y : R) : R :=
  let q := range_sq x y in q + y - 1 - x * (q + crossing_y k q - 1) / crossing_x e k q.

Lemma crossing_on_circles e k q : e = 1 \/ e = -1 -> 0 <= ((k + 2) * (k + 2) - q) * (q - (k - 2) * (k - 2)) ->
  let x1 := crossing_x e k q in let y1 := crossing_y k q in
  x1 * x1 + (y1 - 1) * (y1 - 1) = q /\ x1 * x1 + (y1 + 1) * (y1 + 1) = k * k.
Proof.
  intros side meets x1 y1. assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring).
  assert (square := sqrt_sqrt _ meets). assert (xx : x1 * x1 = ((k + 2) * (k + 2) - q) * (q - (k - 2) * (k - 2)) / 16).
  { unfold x1, crossing_x. set (Q := _ * _) in *. transitivity (e * e * (sqrt Q * sqrt Q) / 16); [field|].
    rewrite ee, square. field. }
  rewrite xx. unfold y1, crossing_y. split; field.
Qed.

Lemma rd_two_arcs e k d x y t u : e = 1 \/ e = -1 -> d = 1 \/ d = -1 -> 0 < k -> moves x y t u ->
  let q := range_sq (x t) (y t) in
  0 < ((k + 2) * (k + 2) - q) * (q - (k - 2) * (k - 2)) -> 0 < q ->
  ~ (x t = crossing_x e k q /\ y t = crossing_y k q) ->
  right_derive (fun s => two_arcs e k d (x s) (y s)) t (-1 + (1 + u) * crossing_margin e k (x t) (y t) / q).
Proof.
  intros side end_ kpos mv q meets qpos apart. destruct mv as [ub [rx ry]].
  assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring).
  destruct (crossing_on_circles e k q side ltac:(lra)) as [inner outer].
  set (Q := fun s => ((k + 2) * (k + 2) - range_sq (x s) (y s)) * (range_sq (x s) (y s) - (k - 2) * (k - 2))).
  set (x1 := fun s => crossing_x e k (range_sq (x s) (y s))). set (y1 := fun s => crossing_y k (range_sq (x s) (y s))).
  fold q in x1, y1. change (crossing_x e k q) with (x1 t) in *. change (crossing_y k q) with (y1 t) in *.
  pose proof (rd_minus _ _ _ _ _ ry (rd_const 1 t)) as ry1. simpl in ry1.
  assert (rq : right_derive (fun s => range_sq (x s) (y s)) t (2 * (1 + u) * x t)).
  { pose proof (rd_plus _ _ _ _ _ (rd_square _ _ _ rx) (rd_square _ _ _ ry1)) as r. simpl in r. unfold range_sq.
    match type of r with right_derive _ _ ?v => replace (2 * (1 + u) * x t) with v; [exact r|] end. ring. }
  assert (ry_ : right_derive y1 t (- ((1 + u) * x t) / 2)).
  { unfold y1, crossing_y. pose proof (rd_scal (/ 4) _ _ _ (rd_minus _ _ _ _ _ (rd_const (k * k) t) rq)) as r. simpl in r.
    apply (rd_ext (fun s => / 4 * (k * k - range_sq (x s) (y s)))); [intros; field|].
    match type of r with right_derive _ _ ?v => replace (- ((1 + u) * x t) / 2) with v; [exact r|] end. field. }
  assert (rpos : 0 < sqrt (Q t)) by (apply sqrt_lt_R0; exact meets).
  assert (x1t : x1 t = e * (sqrt (Q t) / 4)) by reflexivity.
  assert (off : x1 t <> 0) by (rewrite x1t; destruct side as [-> | ->]; lra).
  assert (rx_ : right_derive x1 t ((y1 t + 1) * ((1 + u) * x t) / (2 * x1 t))).
  { assert (rQ : right_derive Q t (16 * ((y1 t + 1) * ((1 + u) * x t)))).
    { pose proof (rd_mult _ _ _ _ _ (rd_minus _ _ _ _ _ (rd_const ((k + 2) * (k + 2)) t) rq)
        (rd_minus _ _ _ _ _ rq (rd_const ((k - 2) * (k - 2)) t))) as r. simpl in r.
      match type of r with right_derive _ _ ?v => replace (16 * ((y1 t + 1) * ((1 + u) * x t))) with v; [exact r|] end.
      fold q. unfold y1, crossing_y. fold q. field. }
    pose proof (rd_scal (e / 4) _ _ _ (rd_sqrt Q t _ meets rQ)) as r. simpl in r.
    apply (rd_ext (fun s => e / 4 * sqrt (Q s))); [intros; unfold x1, crossing_x, Q; field|].
    match type of r with right_derive _ _ ?v => replace ((y1 t + 1) * ((1 + u) * x t) / (2 * x1 t)) with v; [exact r|] end.
    rewrite x1t. destruct side as [-> | ->]; field; lra. }
  pose proof (rd_minus _ _ _ _ _ ry_ (rd_const 1 t)) as ry_1. simpl in ry_1.
  pose proof (rd_plus _ _ _ _ _ ry_ (rd_const 1 t)) as ry_2. simpl in ry_2.
  assert (first : off_cut (- (x t * x1 t + (y t - 1) * (y1 t - 1))) (- (x t * (y1 t - 1) - (y t - 1) * x1 t))).
  { assert (start : x t * x t + (y t - 1) * (y t - 1) = q) by reflexivity.
    apply apart_off_cut; [lra|lra|]. intros [ex ey]. apply apart. lra. }
  assert (second : off_cut (- (0 * x1 t + (d * k - 1 + 1) * (y1 t + 1))) (- (0 * (y1 t + 1) - (d * k - 1 + 1) * x1 t))).
  { apply off_cut_intro. right. destruct end_ as [-> | ->]; nra. }
  pose proof (rd_rotation x (fun s => y s - 1) x1 (fun s => y1 s - 1) t _ _ _ _ rx ry1 rx_ ry_1 first) as r1.
  pose proof (rd_rotation (fun _ => 0) (fun _ => d * k - 1 + 1) x1 (fun s => y1 s + 1) t _ _ _ _
    (rd_const 0 t) (rd_const _ t) rx_ ry_2 second) as r2.
  pose proof (rd_plus _ _ _ _ _ r1 r2) as rate. cbv beta in rate.
  assert (same : forall s, t <= s -> rotation (x s * x1 s + (y s - 1) * (y1 s - 1)) (x s * (y1 s - 1) - (y s - 1) * x1 s)
      + rotation (0 * x1 s + (d * k - 1 + 1) * (y1 s + 1)) (0 * (y1 s + 1) - (d * k - 1 + 1) * x1 s)
    = two_arcs e k d (x s) (y s)).
  { intros s _. unfold two_arcs, right_turn, left_turn. cbv zeta. fold (x1 s) (y1 s). f_equal. f_equal; ring. }
  pose proof (rd_ext _ _ _ _ same rate) as R. clear rate.
  match type of R with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w => replace w with v; [exact R|] end end.
  unfold crossing_margin. cbv zeta. fold q. change (crossing_x e k q) with (x1 t). change (crossing_y k q) with (y1 t).
  rewrite inner. replace (x t * x t + (y t - 1) * (y t - 1)) with q by reflexivity.
  assert (start : x t * x t = q - (y t - 1) * (y t - 1)) by (unfold q, range_sq; ring).
  assert (far : 0 < x1 t * x1 t + (y1 t + 1) * (y1 t + 1)) by (rewrite outer; nra).
  assert (pole : 0 < 0 * 0 + (d * k - 1 + 1) * (d * k - 1 + 1)) by (destruct end_ as [-> | ->]; nra).
  set (X := x1 t) in *. set (Y := y1 t) in *. set (a := x t) in *. set (b := y t) in *.
  assert (circle : X * X = q - (Y - 1) * (Y - 1)) by lra.
  clearbody X Y a b q. clear - far pole qpos off circle start.
  field [start circle]. repeat split; try lra. intros zero. rewrite zero in pole. lra.
Qed.

(** The circles of both arcs cross, and the start is not their crossing. *)
Definition crosses_at (w : word) (rho x y : R) : Prop :=
  match w with
  | RL_left => (rho - 1) * (rho - 1) < range_sq x y < (rho + 3) * (rho + 3) /\ (outer_sq x y <> (rho + 1) * (rho + 1) \/ 0 < x)
  | RL_right => (rho - 1) * (rho - 1) < range_sq x y < (rho + 3) * (rho + 3) /\ (outer_sq x y <> (rho + 1) * (rho + 1) \/ x < 0)
  | LR_left => (rho - 3) * (rho - 3) < outer_sq x y < (rho + 1) * (rho + 1) /\ (range_sq x y <> (rho - 1) * (rho - 1) \/ 0 < x)
  | LR_right => (rho - 3) * (rho - 3) < outer_sq x y < (rho + 1) * (rho + 1) /\ (range_sq x y <> (rho - 1) * (rho - 1) \/ x < 0)
  | _ => False
  end.

Definition margin_of (w : word) (rho x y : R) : R :=
  match w with
  | RL_left => crossing_margin (-1) (rho + 1) x y | RL_right => crossing_margin 1 (rho + 1) x y
  | LR_left => crossing_margin (-1) (rho - 1) x (- y) | LR_right => crossing_margin 1 (rho - 1) x (- y)
  | _ => 0
  end.

Lemma two_arcs_margin e k d x0 y0 : e = 1 \/ e = -1 -> d = 1 \/ d = -1 -> 0 < k ->
  (k - 2) * (k - 2) < range_sq x0 y0 < (k + 2) * (k + 2) -> (outer_sq x0 y0 <> k * k \/ e * x0 < 0) ->
  0 <= crossing_margin e k x0 y0 -> margin_holds (two_arcs e k d) x0 y0.
Proof.
  intros side end_ kpos crosses apart nonneg. set (q := range_sq x0 y0) in *. pose proof (Rle_0_sqr (k - 2)) as low. unfold Rsqr in low. assert (qpos : 0 < q) by lra.
  assert (meets : 0 < ((k + 2) * (k + 2) - q) * (q - (k - 2) * (k - 2))) by (apply Rmult_lt_0_compat; lra).
  assert (M : 0 <= crossing_margin e k x0 y0 / q) by (apply Rmult_le_pos; [exact nonneg|left; apply Rinv_0_lt_compat, qpos]).
  set (m := crossing_margin e k x0 y0 / q) in *. exists (1 - m), (- m). split; [rewrite Rabs_Ropp, Rabs_right by lra; ring|].
  intros x y t u <- <- mv. replace (- (1 - m + u * - m)) with (-1 + (1 + u) * crossing_margin e k (x t) (y t) / q) by (unfold m, Rdiv; ring).
  apply (rd_two_arcs e k d x y t u side end_ kpos mv meets qpos). fold q. intros [ex ey].
  destruct (crossing_on_circles e k q side ltac:(lra)) as [_ outer]. rewrite <- ex, <- ey in outer.
  destruct apart as [off|other]; [apply off; unfold outer_sq; exact outer|].
  assert (ee : e * e = 1) by (destruct side as [-> | ->]; ring). rewrite ex in other. unfold crossing_x in other.
  pose proof (sqrt_pos (((k + 2) * (k + 2) - q) * (q - (k - 2) * (k - 2)))). set (r := sqrt _) in *.
  replace (e * (e * (r / 4))) with (e * e * (r / 4)) in other by ring. rewrite ee in other. lra.
Qed.

Lemma rl_as_two_arcs e rho x y : rl_time e rho x y = two_arcs e (rho + 1) 1 x y.
Proof.
  unfold rl_time, two_arcs, crossing_x, crossing_y. cbv zeta.
  replace (((rho + 1 + 2) * (rho + 1 + 2) - range_sq x y) * (range_sq x y - (rho + 1 - 2) * (rho + 1 - 2)))
    with (((rho + 3) * (rho + 3) - range_sq x y) * (range_sq x y - (rho - 1) * (rho - 1))) by ring.
  replace (((rho + 1) * (rho + 1) - range_sq x y) / 4) with (rho - (range_sq x y - (rho - 1) * (rho - 1)) / 4) by field.
  replace (1 * (rho + 1) - 1) with rho by ring. reflexivity.
Qed.

Lemma lr_as_two_arcs e rho x y : lr_time e rho x y = two_arcs e (rho - 1) (-1) x (- y).
Proof.
  unfold lr_time, two_arcs, crossing_x, crossing_y. cbv zeta.
  replace (range_sq x (- y)) with (outer_sq x y) by (unfold outer_sq, range_sq; ring).
  replace (((rho - 1 + 2) * (rho - 1 + 2) - outer_sq x y) * (outer_sq x y - (rho - 1 - 2) * (rho - 1 - 2)))
    with ((outer_sq x y - (rho - 3) * (rho - 3)) * ((rho + 1) * (rho + 1) - outer_sq x y)) by ring.
  replace (((rho - 1) * (rho - 1) - outer_sq x y) / 4) with (- (rho - ((rho + 1) * (rho + 1) - outer_sq x y) / 4)) by field.
  replace (-1 * (rho - 1) - 1) with (- rho) by ring. rewrite (mirrored_turn x y), (mirrored_turn _ (- _) 0 (- rho)).
  rewrite !Ropp_involutive. reflexivity.
Qed.

(** Wherever their margin is not negative, no control makes the time of RL or LR fall faster than time passes. *)
Theorem two_arcs_margin_holds w rho x y : 1 <= rho -> exists_at w rho x y -> crosses_at w rho x y -> 0 <= margin_of w rho x y ->
  margin_holds (time_of w rho) x y.
Proof.
  intros wide ex crosses nonneg.
  assert (mirror : range_sq x (- y) = outer_sq x y) by (unfold outer_sq, range_sq; ring).
  assert (back : outer_sq x (- y) = range_sq x y) by (unfold outer_sq, range_sq; ring).
  destruct w; simpl in *; try contradiction; destruct crosses as [circles apart].
  - apply (margin_ext (two_arcs (-1) (rho + 1) 1)); [intros; symmetry; apply rl_as_two_arcs|].
    apply two_arcs_margin; [right; reflexivity|left; reflexivity|lra|split; nra| |exact nonneg].
    destruct apart; [left; assumption|right; lra].
  - apply (margin_ext (two_arcs 1 (rho + 1) 1)); [intros; symmetry; apply rl_as_two_arcs|].
    apply two_arcs_margin; [left; reflexivity|left; reflexivity|lra|split; nra| |exact nonneg].
    destruct apart; [left; assumption|right; lra].
  - apply right_margin, (margin_ext (two_arcs (-1) (rho - 1) (-1)));
      [intros a b; rewrite lr_as_two_arcs, Ropp_involutive; reflexivity|]. destruct ex as [wider _].
    apply two_arcs_margin; [right; reflexivity|right; reflexivity|lra|rewrite mirror; split; nra| |exact nonneg].
    rewrite back. destruct apart; [left; assumption|right; lra].
  - apply right_margin, (margin_ext (two_arcs 1 (rho - 1) (-1)));
      [intros a b; rewrite lr_as_two_arcs, Ropp_involutive; reflexivity|]. destruct ex as [wider _].
    apply two_arcs_margin; [left; reflexivity|right; reflexivity|lra|rewrite mirror; split; nra| |exact nonneg].
    rewrite back. destruct apart; [left; assumption|right; lra].
Qed.
