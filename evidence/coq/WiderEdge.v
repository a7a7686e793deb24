(** RL and LR where they become a single arc: RL from the circle of radius [rho - 1] about [(0, 1)], and LR from the last
    circle of L. Their times have a root there, and jump by a whole turn for one of the two crossings. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound Wider WiderMargin WiderStraight WiderCrossing.
Open Scope R_scope.

(** Whatever angle a vector is seen at, its rotation is no less than that, if that is less than a whole turn. *)
Lemma rotation_at_least r d c v : 0 < r -> r * r = d * d + c * c -> r * cos v = d -> r * sin v = c -> v < 2 * PI ->
  v <= rotation d c.
Proof.
  intros pos size ec es below. destruct (Rle_dec v (rotation d c)) as [yes|no]; [exact yes|exfalso].
  destruct (rotation_turns d c) as [fc fs]. pose proof (rotation_bounds d c).
  replace (sqrt (d * d + c * c)) with r in fc, fs by (symmetry; apply sqrt_lem_1; nra).
  assert (same : v = rotation d c); [|lra]. apply same_angle.
  - apply Rabs_lt_between. lra.
  - apply Rmult_eq_reg_l with r; lra.
  - apply Rmult_eq_reg_l with r; lra.
Qed.

Lemma no_rotation d : 0 < d -> rotation d 0 = 0.
Proof.
  intros pos. destruct (rotation_turns d 0) as [fc fs]. pose proof (rotation_bounds d 0).
  replace (sqrt (d * d + 0 * 0)) with d in fc, fs by (symmetry; apply sqrt_lem_1; nra).
  apply same_angle; [apply Rabs_lt_between; lra| |]; apply Rmult_eq_reg_l with d; rewrite ?cos_0, ?sin_0; lra.
Qed.

(** The angle by which [(X, Z)], [c Z] being positive, is turned from [(0, c)]. *)
Lemma tilt r c X Z : c = 1 \/ c = -1 -> 0 < c * Z -> 0 < r -> X * X + Z * Z = r * r ->
  r * cos (atan (- X / Z)) = c * Z /\ r * sin (atan (- X / Z)) = - (c * X).
Proof.
  intros side ahead pos size. assert (cc : c * c = 1) by (destruct side as [-> | ->]; ring).
  assert (Zn : Z <> 0) by (intros zero; rewrite zero in ahead; lra).
  assert (root : sqrt (1 + Rsqr (- X / Z)) = r / (c * Z)).
  { apply sqrt_lem_1; [unfold Rsqr; nra|left; apply Rdiv_lt_0_compat; lra|].
    unfold Rsqr. transitivity ((X * X + Z * Z) / (Z * Z)); [|field; exact Zn]. rewrite size.
    transitivity (r * r / (c * c * (Z * Z))); [field; destruct side as [-> | ->]; split; lra|]. rewrite cc. field. exact Zn. }
  rewrite cos_atan, sin_atan, root. split.
  - field. destruct side as [-> | ->]; repeat split; lra.
  - transitivity (- (c * X)); [|reflexivity]. destruct side as [-> | ->]; field; repeat split; lra.
Qed.

(** The first arc ends where the path ends: [arrived], at the distance [r0] from [(0, 1)]. *)
Lemma single_arc_edge e k c r0 x0 y0 : e = 1 \/ e = -1 -> c = 1 \/ c = -1 -> 0 < k -> 0 < r0 -> c * k - 2 = c * r0 ->
  range_sq x0 y0 = r0 * r0 -> 0 <= r0 * r0 + y0 - 1 ->
  falls_slowly (two_arcs e k c)
    (fun x y => 0 <= ((k + 2) * (k + 2) - range_sq x y) * (range_sq x y - (k - 2) * (k - 2))) x0 y0.
Proof.
  intros side end_ kpos rpos arrived on nonneg x y t u xt yt [ub [rx ry]] eps epos. subst x0 y0.
  set (x0 := x t) in *. set (y0 := y t) in *.
  assert (cc : c * c = 1) by (destruct end_ as [-> | ->]; ring).
  set (q := fun s => range_sq (x s) (y s)). assert (qt : q t = r0 * r0) by exact on.
  set (X := fun s => crossing_x e k (q s)). set (Y := fun s => crossing_y k (q s)).
  assert (Yt : Y t - 1 = c * r0).
  { unfold Y, crossing_y. rewrite qt. replace (k * k) with (c * k * (c * k)) by (transitivity (c * c * (k * k)); [ring|rewrite cc; ring]).
    replace (c * k) with (c * r0 + 2) by lra. transitivity ((c * c * (r0 * r0) - r0 * r0) / 4 + c * r0); [field|rewrite cc; field]. }
  assert (roots : forall v, ((k + 2) * (k + 2) - v) * (v - (k - 2) * (k - 2)) = 16 * (v - (crossing_y k v - 1) * (crossing_y k v - 1)))
    by (intros v; unfold crossing_y; field).
  assert (Xt : X t = 0).
  { unfold X, crossing_x. rewrite roots. change (crossing_y k (q t)) with (Y t). rewrite Yt, qt.
    replace (16 * (r0 * r0 - c * r0 * (c * r0))) with 0; [rewrite sqrt_0; field|].
    replace (c * r0 * (c * r0)) with (c * c * (r0 * r0)) by ring. rewrite cc. ring. }
  (* The start turns by [delta] about [(0, 1)]. *)
  set (p := fun s => (y s - 1) * (y0 - 1) + x s * x0). set (n := fun s => x0 * (y s - 1) - (y0 - 1) * x s).
  assert (p0 : p t = r0 * r0) by (rewrite <- on; unfold p, range_sq, x0, y0; ring).
  assert (n0 : n t = 0) by (unfold n, x0, y0; ring).
  pose proof (rd_minus _ _ _ _ _ ry (rd_const 1 t)) as ry1. simpl in ry1.
  assert (rp : right_derive p t ((y0 - 1) * (- (u * x0)) + x0 * (1 + u * y0))).
  { pose proof (rd_plus _ _ _ _ _ (rd_scal (y0 - 1) _ _ _ ry1) (rd_scal x0 _ _ _ rx)) as r. simpl in r.
    apply (rd_ext (fun s => (y0 - 1) * (y s - 1) + x0 * x s)); [intros; unfold p; ring|].
    match type of r with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w => replace w with v; [exact r|] end end.
    unfold x0, y0. ring. }
  assert (rn : right_derive n t (x0 * (- (u * x0)) - (y0 - 1) * (1 + u * y0))).
  { pose proof (rd_minus _ _ _ _ _ (rd_scal x0 _ _ _ ry1) (rd_scal (y0 - 1) _ _ _ rx)) as r. simpl in r. unfold n.
    match type of r with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w => replace w with v; [exact r|] end end.
    unfold x0, y0. ring. }
  assert (r2 : 0 < r0 * r0) by nra.
  assert (off : off_cut (p t) (n t)) by (apply off_cut_intro; left; lra).
  pose proof (rd_angle_of p n t _ _ off rp rn) as rd. set (delta := fun s => angle_of (p s) (n s)) in *.
  rewrite p0, n0 in rd.
  assert (d0 : delta t = 0) by (unfold delta, angle_of; rewrite n0; unfold Rdiv; rewrite Rmult_0_l, atan_0; ring).
  set (A := right_turn x0 y0 0 (1 + c * r0)).
  assert (below : 0 <= A < 2 * PI) by apply rotation_bounds.
  assert (start : x0 * x0 + (y0 - 1) * (y0 - 1) = r0 * r0) by exact on.
  assert (seen : r0 * cos (- A) = c * (y0 - 1) /\ r0 * sin (- A) = - (c * x0)).
  { assert (equal : x0 * x0 + (y0 - 1) * (y0 - 1) = 0 * 0 + c * r0 * (c * r0)).
    { rewrite start. transitivity (c * c * (r0 * r0)); [rewrite cc; ring|ring]. }
    destruct (turn_of_equals _ _ _ _ equal) as [fc fs]. rewrite start in fc, fs.
    replace (rotation _ _) with A in fc, fs by (unfold A, right_turn; f_equal; ring).
    rewrite cos_neg, sin_neg. split; apply Rmult_eq_reg_l with r0; lra. }
  (* What bounds the time from below. *)
  pose proof (rd_opp _ _ _ rd) as rF.
  assert (rate : right_derive (fun s => - delta s) t (-1 + (1 + u) * (r0 * r0 + y0 - 1) / (r0 * r0))).
  { match type of rF with right_derive _ _ ?v => match goal with |- right_derive _ _ ?w => replace w with v; [exact rF|] end end.
    assert (plane : x0 * x0 = r0 * r0 - (y0 - 1) * (y0 - 1)) by lra. clearbody x0 y0. field [plane]. lra. }
  pose proof (rd_slow (fun s => - delta s) t ((1 + u) * (r0 * r0 + y0 - 1) / (r0 * r0))
    ltac:(apply Rmult_le_pos; [apply Rmult_le_pos; [lra|exact nonneg]|left; apply Rinv_0_lt_compat, r2]) rate eps epos) as slow.
  (* Near the start the crossing is near the end, and the path is no shorter. *)
  assert (lq : filterlim q (at_right t) (locally (r0 * r0))).
  { rewrite <- qt. unfold q. apply fl_range_sq; [exact (rd_right_continuous _ _ _ rx)|exact (rd_right_continuous _ _ _ ry)]. }
  assert (lY : filterlim (fun s => Y s - 1) (at_right t) (locally (c * r0))).
  { rewrite <- Yt. apply fl_minus; [|apply fl_const]. unfold Y, crossing_y. rewrite qt. apply fl_mult; [|apply fl_const].
    apply fl_minus; [apply fl_const|exact lq]. }
  assert (lX : filterlim X (at_right t) (locally 0)).
  { rewrite <- Xt. unfold X, crossing_x. rewrite qt. apply fl_scal. apply fl_mult; [|apply fl_const]. apply fl_sqrt.
    - rewrite <- qt, roots. change (crossing_y k (q t)) with (Y t). rewrite Yt, qt.
      replace (c * r0 * (c * r0)) with (c * c * (r0 * r0)) by ring. rewrite cc. lra.
    - apply fl_mult; apply fl_minus; try apply fl_const; exact lq. }
  assert (ahead1 : at_right t (fun s => 0 < c * (Y s - 1))).
  { apply (fl_above _ (c * (c * r0))); [replace (c * (c * r0)) with (c * c * r0) by ring; rewrite cc; lra|apply fl_scal, lY]. }
  assert (ahead2 : at_right t (fun s => 0 < c * (Y s - 1 + 2))).
  { apply (fl_above _ (c * (c * r0 + 2))); [replace (c * (c * r0 + 2)) with (c * c * k) by (replace (c * r0) with (c * k - 2) by lra; ring);
      rewrite cc; lra|]. apply fl_scal, fl_plus; [exact lY|apply fl_const]. }
  assert (cont : filterlim (fun s => atan (- X s / (Y s - 1)) - (- A + delta s)) (at_right t)
      (locally (atan (- 0 / (c * r0)) - (- A + 0)))).
  { apply fl_minus.
    - apply (fl_derive atan (fun s => - X s / (Y s - 1)) _ _ (is_derive_atan _)). apply fl_mult; [apply fl_opp, lX|].
      apply fl_inv; [destruct end_ as [-> | ->]; lra|exact lY].
    - apply fl_plus; [apply fl_const|]. rewrite <- d0. exact (rd_right_continuous _ _ _ rd). }
  assert (less : atan (- 0 / (c * r0)) - (- A + 0) < 2 * PI).
  { replace (- 0 / (c * r0)) with 0 by (field; destruct end_ as [-> | ->]; lra). rewrite atan_0. lra. }
  pose proof (fl_below _ _ (2 * PI) less cont) as small.
  assert (small' : at_right t (fun s => - (- A + delta s) < 2 * PI)).
  { apply (fl_below _ (- (- A + 0))); [lra|]. apply fl_opp, fl_plus; [apply fl_const|]. rewrite <- d0. exact (rd_right_continuous _ _ _ rd). }
  assert (away : at_right t (fun s => 0 < p s)).
  { apply (fl_above p (p t)); [lra|exact (rd_right_continuous _ _ _ rp)]. }
  assert (long : at_right t (fun s => 0 < q s)) by (apply (fl_above q (r0 * r0)); [exact r2|exact lq]).
  generalize (filter_and _ _ small (filter_and _ _ small' (filter_and _ _ away (filter_and _ _ long
    (filter_and _ _ ahead1 (filter_and _ _ ahead2 slow)))))).
  apply filter_imp. intros s (lt & lt' & ps & qs & a1 & a2 & le) meets.
  destruct (crossing_on_circles e k (q s) side meets) as [inner outer].
  change (crossing_x e k (q s)) with (X s) in *. change (crossing_y k (q s)) with (Y s) in *.
  set (r := sqrt (q s)). assert (rr : r * r = q s) by (apply sqrt_sqrt; lra). assert (rs : 0 < r) by (apply sqrt_lt_R0, qs).
  set (phi := - A + delta s) in *.
  assert (seen_s : r * cos phi = c * (y s - 1) /\ r * sin phi = - (c * x s)).
  { destruct seen as [ec es]. assert (off_s : off_cut (p s) (n s)) by (apply off_cut_intro; left; exact ps).
    destruct (cos_sin_angle_of _ _ off_s) as [gc gs]. fold (delta s) in gc, gs.
    assert (lengths : sqrt (p s * p s + n s * n s) = r0 * r).
    { apply sqrt_lem_1; [nra|nra|]. transitivity (r0 * r0 * (r * r)); [ring|]. rewrite rr, <- start. unfold p, n, q, range_sq. ring. }
    rewrite lengths in gc, gs. unfold phi. split; apply Rmult_eq_reg_l with (r0 * r0); try lra.
    - rewrite cos_plus. transitivity (r0 * cos (- A) * (r0 * r * cos (delta s)) - r0 * sin (- A) * (r0 * r * sin (delta s))); [ring|].
      rewrite ec, es, gc, gs, <- start. unfold p, n. ring.
    - rewrite sin_plus. transitivity (r0 * sin (- A) * (r0 * r * cos (delta s)) + r0 * cos (- A) * (r0 * r * sin (delta s))); [ring|].
      rewrite ec, es, gc, gs, <- start. unfold p, n. ring. }
  destruct seen_s as [sc ss].
  destruct (tilt r c (X s) (Y s - 1) end_ a1 rs ltac:(lra)) as [bc bs].
  replace (Y s - 1 + 2) with (Y s + 1) in a2 by ring.
  destruct (tilt k c (X s) (Y s + 1) end_ a2 kpos ltac:(lra)) as [cc_ cs].
  set (beta := atan (- X s / (Y s - 1))) in *. set (beta2 := atan (- X s / (Y s + 1))) in *.
  assert (first : beta - phi <= right_turn (x s) (y s) (X s) (Y s)).
  { unfold right_turn. apply (rotation_at_least (r * r)); [nra| | | |exact lt].
    - transitivity (q s * q s); [rewrite rr; reflexivity|]. rewrite <- inner at 2. unfold q, range_sq. ring.
    - rewrite cos_minus. transitivity (r * cos beta * (r * cos phi) + r * sin beta * (r * sin phi)); [ring|].
      rewrite bc, bs, sc, ss. transitivity (c * c * (x s * X s + (y s - 1) * (Y s - 1))); [ring|rewrite cc; ring].
    - rewrite sin_minus. transitivity (r * sin beta * (r * cos phi) - r * cos beta * (r * sin phi)); [ring|].
      rewrite bc, bs, sc, ss. transitivity (c * c * (x s * (Y s - 1) - (y s - 1) * X s)); [ring|rewrite cc; ring]. }
  assert (second : forall v, cos v = cos beta2 -> sin v = sin beta2 -> v < 2 * PI -> v <= left_turn (X s) (Y s) 0 (c * k - 1)).
  { intros v vc vs vl. unfold left_turn. apply (rotation_at_least (k * k)); [nra| | | |exact vl].
    - rewrite <- outer at 2. transitivity ((X s * X s + (Y s + 1) * (Y s + 1)) * (c * c * (k * k))); [rewrite cc, outer; ring|ring].
    - rewrite vc. transitivity (k * (k * cos beta2)); [ring|]. rewrite cc_. ring.
    - rewrite vs. transitivity (k * (k * sin beta2)); [ring|]. rewrite cs. ring. }
  pose proof (atan_bound (- X s / (Y s - 1))) as bb. fold beta in bb. pose proof (atan_bound (- X s / (Y s + 1))) as b2. fold beta2 in b2.
  pose proof PI_RGT_0.
  assert (total : - phi <= right_turn (x s) (y s) (X s) (Y s) + left_turn (X s) (Y s) 0 (c * k - 1)).
  { destruct (Rle_dec (c * X s) 0) as [later|sooner].
    - assert (0 <= beta).
      { apply Rnot_lt_le. intros neg. pose proof (sin_lt_0_var beta ltac:(lra) neg). nra. }
      assert (0 <= beta2).
      { apply Rnot_lt_le. intros neg. pose proof (sin_lt_0_var beta2 ltac:(lra) neg). nra. }
      pose proof (second beta2 eq_refl eq_refl ltac:(lra)). lra.
    - assert (beta2 < 0).
      { apply Rnot_le_lt. intros pos. pose proof (sin_ge_0 beta2 pos ltac:(lra)). nra. }
      pose proof (second (beta2 + 2 * PI) ltac:(rewrite cos_plus, cos_2PI, sin_2PI; ring)
        ltac:(rewrite sin_plus, cos_2PI, sin_2PI; ring) ltac:(lra)). lra. }
  assert (now : two_arcs e k c x0 y0 = A).
  { unfold two_arcs. cbv zeta. change (range_sq x0 y0) with (q t). change (crossing_x e k (q t)) with (X t). change (crossing_y k (q t)) with (Y t).
    rewrite Xt. replace (Y t) with (1 + c * r0) by lra. replace (left_turn _ _ _ _) with 0; [unfold A; ring|].
    symmetry. unfold left_turn. replace (c * k - 1) with (1 + c * r0) by lra.
    replace ((1 + c * r0 + 1) * 0 - 0 * (1 + c * r0 + 1)) with 0 by ring. apply no_rotation.
    replace (1 + c * r0 + 1) with (c * k) by lra. replace (0 * 0 + c * k * (c * k)) with (c * c * (k * k)) by ring.
    rewrite cc, Rmult_1_l. apply Rmult_lt_0_compat; assumption. }
  rewrite now. unfold two_arcs. cbv zeta. fold (q s). change (crossing_x e k (q s)) with (X s). change (crossing_y k (q s)) with (Y s).
  unfold phi in total. rewrite d0 in le. lra.
Qed.

(** RL on the circle of radius [rho - 1], where R alone leads to the target, and LR on the last circle of L. *)
Definition is_single_arc (w : word) (rho x y : R) : Prop :=
  match w with
  | RL_left | RL_right => range_sq x y = (rho - 1) * (rho - 1) /\ 0 <= range_sq x y + y - 1
  | LR_left | LR_right => outer_sq x y = (rho + 1) * (rho + 1)
  | _ => False
  end.

Lemma rl_edge_slowly e rho x y : e = 1 \/ e = -1 -> 1 < rho -> range_sq x y = (rho - 1) * (rho - 1) -> 0 <= range_sq x y + y - 1 ->
  falls_slowly (rl_time e rho) (rl_exists rho) x y.
Proof.
  intros side wide on nonneg. rewrite on in nonneg.
  apply (slowly_from (two_arcs e (rho + 1) 1) _
    (fun x y => 0 <= ((rho + 1 + 2) * (rho + 1 + 2) - range_sq x y) * (range_sq x y - (rho + 1 - 2) * (rho + 1 - 2))) _ 0).
  - intros a b. rewrite rl_as_two_arcs. ring.
  - intros a b [low high]. apply Rmult_le_pos; lra.
  - apply (single_arc_edge e (rho + 1) 1 (rho - 1)); [exact side|left; reflexivity|lra|lra|ring|exact on|lra].
Qed.

Lemma lr_edge_slowly e rho x y : e = 1 \/ e = -1 -> 1 < rho -> outer_sq x y = (rho + 1) * (rho + 1) ->
  falls_slowly (lr_time e rho) (lr_exists rho) x y.
Proof.
  intros side wide on. assert (mirror : forall x y, range_sq x (- y) = outer_sq x y) by (intros; unfold outer_sq, range_sq; ring).
  assert (high : 0 <= (rho + 1) * (rho + 1) + - y - 1) by (unfold outer_sq in on; nra).
  apply (slowly_from (fun x y => two_arcs e (rho - 1) (-1) x (- y)) _
    (fun x y => 0 <= ((rho - 1 + 2) * (rho - 1 + 2) - range_sq x (- y)) * (range_sq x (- y) - (rho - 1 - 2) * (rho - 1 - 2))) _ 0).
  - intros a b. rewrite lr_as_two_arcs. ring.
  - intros a b (_ & low & far). rewrite mirror. apply Rmult_le_pos; lra.
  - apply (slowly_mirrored (two_arcs e (rho - 1) (-1))
      (fun x y => 0 <= ((rho - 1 + 2) * (rho - 1 + 2) - range_sq x y) * (range_sq x y - (rho - 1 - 2) * (rho - 1 - 2)))).
    apply (single_arc_edge e (rho - 1) (-1) (rho + 1));
      [exact side|right; reflexivity|lra|lra|ring|rewrite mirror; exact on|exact high].
Qed.

(** There their times, with a root and with a jump by a whole turn, fall no faster than time passes. *)
Theorem single_arc_falls_slowly w rho x y : 1 < rho -> is_single_arc w rho x y ->
  falls_slowly (time_of w rho) (exists_at w rho) x y.
Proof.
  intros wide edge. destruct w; simpl in *; try contradiction.
  - destruct edge. apply rl_edge_slowly; try assumption. right; reflexivity.
  - destruct edge. apply rl_edge_slowly; try assumption. left; reflexivity.
  - apply lr_edge_slowly; try assumption. right; reflexivity.
  - apply lr_edge_slowly; try assumption. left; reflexivity.
Qed.
