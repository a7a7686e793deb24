(** The fastest entry of a Dubins vehicle onto the circle of its turn radius, in either direction. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value Nearby LowerBound Attained.
Open Scope R_scope.

(** * The vehicle *)

(** A flight of duration [T]: the position [(X, Y)] moves at unit speed along the heading [th], which turns at the rate
    [u], at most 1 either way. *)
Record flight (X Y th u : R -> R) (T : R) : Prop := {
  time_nonneg : 0 <= T;
  turn_bounded : forall t, 0 <= t < T -> -1 <= u t <= 1;
  X_continuous : forall t, 0 < t <= T -> left_continuous X t;
  Y_continuous : forall t, 0 < t <= T -> left_continuous Y t;
  th_continuous : forall t, 0 < t <= T -> left_continuous th t;
  X_moves : forall t, 0 <= t < T -> right_derive X t (cos (th t));
  Y_moves : forall t, 0 <= t < T -> right_derive Y t (sin (th t));
  th_moves : forall t, 0 <= t < T -> right_derive th t (u t)
}.

(** On the circle of radius [rho] about the origin, along its tangent, clockwise or counter-clockwise. *)
Definition on_circle (rho X Y th : R) : Prop :=
  (X = - (rho * sin th) /\ Y = rho * cos th) \/ (X = rho * sin th /\ Y = - (rho * cos th)).

(** * Reduction *)

(** The position relative to the centre of the circle, in axes along and to the left of the heading. *)
Definition along (X Y th : R) : R := X * cos th + Y * sin th.
Definition across (X Y th : R) : R := - (X * sin th) + Y * cos th.

Lemma from_reduced X0 Y0 th0 :
  X0 = along X0 Y0 th0 * cos th0 - across X0 Y0 th0 * sin th0 /\ Y0 = along X0 Y0 th0 * sin th0 + across X0 Y0 th0 * cos th0.
Proof.
  unfold along, across. pose proof (sin2_cos2 th0) as one. unfold Rsqr in one. split.
  - transitivity (X0 * (sin th0 * sin th0 + cos th0 * cos th0)); [rewrite one; ring|ring].
  - transitivity (Y0 * (sin th0 * sin th0 + cos th0 * cos th0)); [rewrite one; ring|ring].
Qed.

Lemma rd_cos f t l : right_derive f t l -> right_derive (fun s => cos (f s)) t (- sin (f t) * l).
Proof. apply (rd_comp cos). apply is_derive_cos. Qed.

Lemma rd_sin f t l : right_derive f t l -> right_derive (fun s => sin (f s)) t (cos (f t) * l).
Proof. apply (rd_comp sin). apply is_derive_sin. Qed.

Lemma lc_cos f t : left_continuous f t -> left_continuous (fun s => cos (f s)) t.
Proof. exact (fl_derive cos f _ _ (is_derive_cos _)). Qed.

Lemma lc_sin f t : left_continuous f t -> left_continuous (fun s => sin (f s)) t.
Proof. exact (fl_derive sin f _ _ (is_derive_sin _)). Qed.

Lemma reduced X Y th u T : flight X Y th u T ->
  trajectory (fun t => along (X t) (Y t) (th t)) (fun t => across (X t) (Y t) (th t)) u T.
Proof.
  intros [T0 ub lX lY lth mX mY mth]. unfold along, across. constructor.
  - exact T0.
  - exact ub.
  - intros t inside. apply fl_plus; apply fl_mult; [apply lX, inside|apply lc_cos, lth, inside|apply lY, inside|apply lc_sin, lth, inside].
  - intros t inside. apply fl_plus; [apply fl_opp|]; apply fl_mult;
      [apply lX, inside|apply lc_sin, lth, inside|apply lY, inside|apply lc_cos, lth, inside].
  - intros t inside.
    pose proof (rd_plus _ _ _ _ _ (rd_mult _ _ _ _ _ (mX t inside) (rd_cos _ _ _ (mth t inside)))
      (rd_mult _ _ _ _ _ (mY t inside) (rd_sin _ _ _ (mth t inside)))) as rd. simpl in rd.
    match type of rd with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
      replace g with v; [exact rd|] end end.
    pose proof (sin2_cos2 (th t)) as one. unfold Rsqr in one. rewrite <- one. ring.
  - intros t inside.
    pose proof (rd_plus _ _ _ _ _ (rd_opp _ _ _ (rd_mult _ _ _ _ _ (mX t inside) (rd_sin _ _ _ (mth t inside))))
      (rd_mult _ _ _ _ _ (mY t inside) (rd_cos _ _ _ (mth t inside)))) as rd. simpl in rd.
    match type of rd with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
      replace g with v; [exact rd|] end end. ring.
Qed.

(** * The other half plane *)

(** The state reflected into the upper half plane moves under the control that is reflected with it. *)
Lemma reflected x y u T : trajectory x y u T ->
  exists v, trajectory x (fun t => Rabs (y t)) v T.
Proof.
  intros [T0 ub lx ly mx my].
  set (v := fun t => if Rlt_dec 0 (y t) then u t else if Rlt_dec (y t) 0 then - u t
    else if Rle_dec 0 (x t) then - Rabs (u t) else Rabs (u t)).
  exists v. constructor.
  - exact T0.
  - intros t inside. specialize (ub t inside). unfold v.
    assert (Rabs (u t) <= 1) by (apply Rabs_le; lra). pose proof (Rabs_pos (u t)).
    destruct (Rlt_dec 0 (y t)); [lra|]. destruct (Rlt_dec (y t) 0); [lra|]. destruct (Rle_dec 0 (x t)); lra.
  - exact lx.
  - intros t inside. apply (fl_comp Rabs y); [apply continuity_pt_filterlim, Rcontinuity_abs|exact (ly t inside)].
  - intros t inside. replace (1 + v t * Rabs (y t)) with (1 + u t * y t); [exact (mx t inside)|].
    unfold v. destruct (Rlt_dec 0 (y t)); [rewrite Rabs_right; lra|].
    destruct (Rlt_dec (y t) 0); [rewrite Rabs_left by lra; ring|].
    assert (zero : y t = 0) by lra. rewrite zero, Rabs_R0. ring.
  - intros t inside. pose proof (my t inside) as rd. pose proof (rd_right_continuous _ _ _ rd) as lim. unfold v.
    destruct (Rlt_dec 0 (y t)) as [pos|].
    { destruct (fl_above y _ 0 pos lim) as [[e epos] H]. intros eps p. destruct (rd eps p) as [d [dpos D]].
      pose proof (Rmin_l d e). pose proof (Rmin_r d e). exists (Rmin d e). split; [apply Rmin_pos; assumption|].
      intros s near. assert (0 < y s) by (apply H; [change (Rabs (s - t) < e); apply Rabs_lt_between|]; lra).
      rewrite !Rabs_right with (r := y _) by lra. apply D. lra. }
    destruct (Rlt_dec (y t) 0) as [neg|].
    { destruct (fl_below y _ 0 neg lim) as [[e epos] H]. intros eps p.
      destruct (rd_opp _ _ _ rd eps p) as [d [dpos D]].
      pose proof (Rmin_l d e). pose proof (Rmin_r d e). exists (Rmin d e). split; [apply Rmin_pos; assumption|].
      intros s near. assert (y s < 0) by (apply H; [change (Rabs (s - t) < e); apply Rabs_lt_between|]; lra).
      rewrite !Rabs_left with (r := y _) by lra.
      replace (- (- u t * x t)) with (- - (u t * x t)) by ring. apply D. lra. }
    assert (zero : y t = 0) by lra.
    intros eps p. destruct (rd eps p) as [d [dpos D]]. exists d. split; [exact dpos|]. intros s near.
    specialize (D s near). rewrite zero, Rabs_R0 in *. rewrite Rminus_0_r in *.
    set (l := - (u t * x t)) in *.
    assert (rate : - ((if Rle_dec 0 (x t) then - Rabs (u t) else Rabs (u t)) * x t) = Rabs l).
    { unfold l. rewrite Rabs_Ropp, Rabs_mult. destruct (Rle_dec 0 (x t)).
      - rewrite (Rabs_right (x t)) by lra. ring.
      - rewrite (Rabs_left (x t)) by lra. ring. }
    rewrite rate. replace (Rabs l * (s - t)) with (Rabs (l * (s - t))) by (rewrite Rabs_mult, (Rabs_right (s - t)); lra).
    eapply Rle_trans; [apply Rabs_triang_inv2|exact D].
Qed.

(** The mirror image of a trajectory. *)
Lemma mirrored x0 y0 T x1 y1 : reaches x0 y0 T x1 y1 -> reaches x0 (- y0) T x1 (- y1).
Proof.
  intros (x & y & th & u & [T0 ub lx ly mx my] & (h0 & lh & mh) & ex & ey & fx & fy).
  exists x, (fun t => - y t), (fun t => - th t), (fun t => - u t).
  split; [constructor|split; [split; [|split]|]].
  - exact T0.
  - intros t inside. specialize (ub t inside). lra.
  - exact lx.
  - intros t inside. apply fl_opp, ly, inside.
  - intros t inside. replace (1 + - u t * - y t) with (1 + u t * y t) by ring. apply mx, inside.
  - intros t inside. replace (- (- u t * x t)) with (- - (u t * x t)) by ring. apply rd_opp, my, inside.
  - rewrite h0. ring.
  - intros t inside. apply fl_opp, lh, inside.
  - intros t inside. apply rd_opp, mh, inside.
  - rewrite ex, ey, fx, fy. repeat split.
Qed.

(** A trajectory of the reduced state, turned back into a flight from a given heading. *)
Lemma flown x0 y0 T x1 y1 th0 : reaches x0 y0 T x1 y1 ->
  exists X Y th u, flight X Y th u T
    /\ X 0 = x0 * cos th0 - y0 * sin th0 /\ Y 0 = x0 * sin th0 + y0 * cos th0 /\ th 0 = th0
    /\ X T = x1 * cos (th T) - y1 * sin (th T) /\ Y T = x1 * sin (th T) + y1 * cos (th T).
Proof.
  intros (x & y & h & u & [T0 ub lx ly mx my] & (h0 & lh & mh) & ex & ey & fx & fy).
  set (th := fun t => th0 + h t).
  assert (lth : forall t, 0 < t <= T -> left_continuous th t).
  { intros t inside. apply fl_plus; [apply fl_const|apply lh, inside]. }
  assert (mth : forall t, 0 <= t < T -> right_derive th t (u t)).
  { intros t inside. replace (u t) with (0 + u t) by ring. apply rd_plus; [apply rd_const|apply mh, inside]. }
  exists (fun t => x t * cos (th t) - y t * sin (th t)), (fun t => x t * sin (th t) + y t * cos (th t)), th, u.
  split; [constructor|].
  - exact T0.
  - exact ub.
  - intros t inside. apply fl_minus; apply fl_mult;
      [apply lx, inside|apply lc_cos, lth, inside|apply ly, inside|apply lc_sin, lth, inside].
  - intros t inside. apply fl_plus; apply fl_mult;
      [apply lx, inside|apply lc_sin, lth, inside|apply ly, inside|apply lc_cos, lth, inside].
  - exact lth.
  - intros t inside.
    pose proof (rd_minus _ _ _ _ _ (rd_mult _ _ _ _ _ (mx t inside) (rd_cos _ _ _ (mth t inside)))
      (rd_mult _ _ _ _ _ (my t inside) (rd_sin _ _ _ (mth t inside)))) as rd. simpl in rd.
    match type of rd with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
      replace g with v; [exact rd|] end end. ring.
  - intros t inside.
    pose proof (rd_plus _ _ _ _ _ (rd_mult _ _ _ _ _ (mx t inside) (rd_sin _ _ _ (mth t inside)))
      (rd_mult _ _ _ _ _ (my t inside) (rd_cos _ _ _ (mth t inside)))) as rd. simpl in rd.
    match type of rd with right_derive _ _ ?v => match goal with |- right_derive _ _ ?g =>
      replace g with v; [exact rd|] end end. ring.
  - exact mth.
  - assert (start : th 0 = th0) by (unfold th; rewrite h0; ring).
    rewrite ex, ey, fx, fy, start. repeat split.
Qed.

(** * The theorem *)

(** Some flight onto the circle takes [least_time] of its reduced state. *)
Theorem least_time_is_flown X0 Y0 th0 :
  exists X Y th u, flight X Y th u (least_time (along X0 Y0 th0) (across X0 Y0 th0))
    /\ X 0 = X0 /\ Y 0 = Y0 /\ th 0 = th0
    /\ let T := least_time (along X0 Y0 th0) (across X0 Y0 th0) in on_circle 1 (X T) (Y T) (th T).
Proof.
  destruct (from_reduced X0 Y0 th0) as [backX backY].
  set (x0 := along X0 Y0 th0) in *. set (y0 := across X0 Y0 th0) in *.
  assert (r : exists y1, (y1 = 1 \/ y1 = - (1)) /\ reaches x0 y0 (least_time x0 y0) 0 y1).
  { unfold least_time. destruct (Rle_dec 0 y0) as [up|down].
    - exists 1. split; [left; reflexivity|]. rewrite Rabs_right by lra. apply attained_up, up.
    - exists (- (1)). split; [right; reflexivity|]. rewrite Rabs_left by lra.
      replace y0 with (- - y0) at 1 by ring. apply mirrored, attained_up. lra. }
  destruct r as (y1 & side & r). destruct (flown _ _ _ _ _ th0 r) as (X & Y & th & u & fl & eX & eY & eth & fX & fY).
  exists X, Y, th, u. split; [exact fl|]. split; [rewrite eX, <- backX; reflexivity|].
  split; [rewrite eY, <- backY; reflexivity|]. split; [exact eth|].
  simpl. rewrite fX, fY. destruct side as [->| ->]; [left|right]; split; ring.
Qed.

(** No flight onto the circle takes less. *)
Theorem least_time_is_least X0 Y0 th0 X Y th u T :
  flight X Y th u T -> X 0 = X0 -> Y 0 = Y0 -> th 0 = th0 -> on_circle 1 (X T) (Y T) (th T) ->
  least_time (along X0 Y0 th0) (across X0 Y0 th0) <= T.
Proof.
  intros fl <- <- <- ends. destruct (reflected _ _ _ _ (reduced _ _ _ _ _ fl)) as [v tr].
  unfold on_circle in ends. rewrite !Rmult_1_l in ends. unfold least_time.
  apply (not_sooner_up _ _ v T tr); [intros; apply Rabs_pos| |]; simpl; unfold along, across;
    pose proof (sin2_cos2 (th T)) as one; unfold Rsqr in one.
  - destruct ends as [[-> ->]|[-> ->]]; ring.
  - destruct ends as [[-> ->]|[-> ->]].
    + replace (- (- sin (th T) * sin (th T)) + cos (th T) * cos (th T)) with 1 by lra. apply Rabs_R1.
    + replace (- (sin (th T) * sin (th T)) + - cos (th T) * cos (th T)) with (- (1)) by lra.
      rewrite Rabs_Ropp. apply Rabs_R1.
Qed.
