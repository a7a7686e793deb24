(** A flight that ends beside the circle is a flight onto it from a start that lies as far beside its own. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Value Synthesis Clockwise Wider WiderMargin WiderStraight WiderCrossing WiderLRL WiderEdge.
Open Scope R_scope.

(** The flight moved as a whole, without turning it. *)
Lemma displaced X Y th u T dx dy : flight X Y th u T ->
  flight (fun t => X t + dx) (fun t => Y t + dy) th u T.
Proof.
  intros [T0 ub lX lY lth mX mY mth]. constructor.
  - exact T0.
  - exact ub.
  - intros t inside. apply fl_plus; [apply lX, inside|apply fl_const].
  - intros t inside. apply fl_plus; [apply lY, inside|apply fl_const].
  - exact lth.
  - intros t inside. replace (cos (th t)) with (cos (th t) + 0) by ring. apply rd_plus; [apply mX, inside|apply rd_const].
  - intros t inside. replace (sin (th t)) with (sin (th t) + 0) by ring. apply rd_plus; [apply mY, inside|apply rd_const].
  - exact mth.
Qed.

(** The square of the distance between two points of the plane. *)
Definition distance_sq (x0 y0 x1 y1 : R) : R := (x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0).

(** The reduced states of two starts with the same heading are as far apart as the starts. *)
Lemma reduction_keeps_distances X0 Y0 X1 Y1 th :
  distance_sq (along X0 Y0 th) (across X0 Y0 th) (along X1 Y1 th) (across X1 Y1 th) = distance_sq X0 Y0 X1 Y1.
Proof.
  unfold distance_sq, along, across. pose proof (sin2_cos2 th) as one. unfold Rsqr in one.
  transitivity (((X1 - X0) * (X1 - X0) + (Y1 - Y0) * (Y1 - Y0)) * (sin th * sin th + cos th * cos th)); [ring|].
  rewrite one. ring.
Qed.

Section Neighbour.
  Variable ends : R -> R -> R -> Prop.
  Variable least : R -> R -> R.
  Hypothesis is_least : forall X0 Y0 th0 X Y th u T,
    flight X Y th u T -> X 0 = X0 -> Y 0 = Y0 -> th 0 = th0 -> ends (X T) (Y T) (th T) ->
    least (along X0 Y0 th0) (across X0 Y0 th0) <= T.

  Lemma neighbour X Y th u T delta Xc Yc :
    flight X Y th u T -> ends Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta * delta ->
    exists x y,
      distance_sq (along (X 0) (Y 0) (th 0)) (across (X 0) (Y 0) (th 0)) x y <= delta * delta /\ least x y <= T.
  Proof.
    intros fl on near. set (dx := Xc - X T). set (dy := Yc - Y T).
    exists (along (X 0 + dx) (Y 0 + dy) (th 0)), (across (X 0 + dx) (Y 0 + dy) (th 0)). split.
    - rewrite reduction_keeps_distances. unfold distance_sq in *. unfold dx, dy.
      replace (X 0 + (Xc - X T) - X 0) with (Xc - X T) by ring.
      replace (Y 0 + (Yc - Y T) - Y 0) with (Yc - Y T) by ring. exact near.
    - apply (is_least _ _ _ _ _ th u T (displaced _ _ _ _ _ dx dy fl)); try reflexivity.
      simpl. unfold dx, dy. replace (X T + (Xc - X T)) with Xc by ring. replace (Y T + (Yc - Y T)) with Yc by ring.
      exact on.
  Qed.
End Neighbour.

(** A flight that ends at a distance of at most [delta] from a point at which, with its last heading, it would be on the
    circle takes no less than [least_time] of some reduced state that is no farther from its own. *)
Theorem least_time_of_a_neighbour X Y th u T delta Xc Yc :
  flight X Y th u T -> on_circle 1 Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta * delta ->
  exists x y,
    distance_sq (along (X 0) (Y 0) (th 0)) (across (X 0) (Y 0) (th 0)) x y <= delta * delta /\ least_time x y <= T.
Proof. apply neighbour, least_time_is_least. Qed.

(** The same clockwise. *)
Theorem least_time_clockwise_of_a_neighbour X Y th u T delta Xc Yc :
  flight X Y th u T -> on_clockwise_circle 1 Xc Yc (th T) -> distance_sq (X T) (Y T) Xc Yc <= delta * delta ->
  exists x y,
    distance_sq (along (X 0) (Y 0) (th 0)) (across (X 0) (Y 0) (th 0)) x y <= delta * delta
    /\ least_time_clockwise x y <= T.
Proof. apply neighbour, least_time_clockwise_is_least. Qed.

(** * What all this rests on *)

Definition theorems := (least_time_is_flown, least_time_is_least, least_time_of_a_neighbour,
  least_time_clockwise_is_flown, least_time_clockwise_is_least, least_time_clockwise_of_a_neighbour,
  word_is_flown, least_of_words_is_least, least_of_words_is_flown, least_of_words_is_flown_either, straight_margin,
  straight_falls_slowly, faster_below_the_axis, faster_above_the_axis, two_arcs_margin_holds, lrl_margin_holds,
  single_arc_falls_slowly).

Print Assumptions theorems.
