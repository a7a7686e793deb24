(** Which formula gives the least time at a state and at the states near it. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Value.
Open Scope R_scope.

(** What holds for [(x', y')] near enough to [(x, y)]: strict inequalities persist. *)
Record near (x y x' y' : R) : Prop := {
  not_target : range_sq x' y' <> 0;
  far : 4 < range_sq x y -> 4 < range_sq x' y';
  close : range_sq x y < 4 -> range_sq x' y' < 4;
  outside : 4 < outer_sq x y -> 4 < outer_sq x' y';
  within : outer_sq x y < 4 -> outer_sq x' y' < 4;
  before_curve : outer_sq x y < 4 -> x < curve_x (outer_sq x y) -> x' < curve_x (outer_sq x' y');
  after_curve : outer_sq x y < 4 -> curve_x (outer_sq x y) < x -> curve_x (outer_sq x' y') < x';
  end_of_curve : outer_sq x y = 4 -> 0 < x -> ~ left_first x' y'
}.

(** The switching curve ends at the target. *)
Lemma curve_narrow P : 1 <= P < 4 -> 3 * (curve_x P * curve_x P) <= 4 - P.
Proof.
  intros bounds. pose proof (s_of_proper P bounds) as ps. pose proof (circle_of_s P bounds) as circle.
  pose proof (proper_inside _ ps) as inside. pose proof (m_of_above P bounds) as mpos. pose proof (s_of_above P bounds) as above. pose proof (w_over_2s _ ps) as wpos.
  pose proof (c_sq _ inside) as cc. pose proof (w_sq (s_of P)) as ww. destruct ps as [spos [_ below]].
  unfold curve_x, circle_sq in *. set (s := s_of P) in *. set (c := c_of s) in *.
  unfold m_of in *. set (w := w_of s) in *.
  assert (m1 : (3 * s - w) * (3 * s - w) <= 1) by nra.
  replace ((3 * s - w) * c * ((3 * s - w) * c)) with ((3 * s - w) * (3 * s - w) * (c * c)) by ring.
  assert (c2 : 0 <= c * c) by nra.
  assert (narrow : 3 * (c * c) <= 8 * s * (w - 2 * s)); [|nra].
  assert (w2 : w <= 2) by nra.
  assert (diff : (w - 2 * s) * (w + 2 * s) = 3 * (c * c)) by nra.
  assert (s6 : 6 / 10 <= s) by nra.
  nra.
Qed.

Lemma curve_x_nonneg P : 1 <= P < 4 -> 0 <= curve_x P.
Proof.
  intros bounds. pose proof (s_of_proper P bounds) as ps. unfold curve_x.
  apply Rmult_le_pos; [apply m_of_above, bounds|]. left. apply c_pos, proper_inside, ps.
Qed.

Section Along.
  Context {F : (R -> Prop) -> Prop} {FF : Filter F}.
  Variables (x y : R -> R) (x0 y0 : R).
  Hypothesis lx : filterlim x F (locally x0).
  Hypothesis ly : filterlim y F (locally y0).

  Lemma fl_range_sq : filterlim (fun s => range_sq (x s) (y s)) F (locally (range_sq x0 y0)).
  Proof.
    unfold range_sq. apply fl_plus; [apply fl_mult; assumption|].
    apply fl_mult; (apply fl_minus; [exact ly|apply fl_const]).
  Qed.

  Lemma fl_outer_sq : filterlim (fun s => outer_sq (x s) (y s)) F (locally (outer_sq x0 y0)).
  Proof.
    unfold outer_sq. apply fl_plus; [apply fl_mult; assumption|].
    apply fl_mult; (apply fl_plus; [exact ly|apply fl_const]).
  Qed.

  Lemma fl_discriminant (f : R -> R) P : filterlim f F (locally P) ->
    filterlim (fun s => discriminant (f s)) F (locally (discriminant P)).
  Proof.
    intros lf. pose proof (fl_plus _ _ _ _ (fl_mult _ _ _ _ lf (fl_const (/ 2))) (fl_const 1)) as half.
    unfold discriminant. apply fl_minus; [apply fl_mult; exact half|].
    apply fl_scal, fl_mult; (apply fl_minus; [exact lf|apply fl_const]).
  Qed.

  Lemma fl_s_of (f : R -> R) P : reachable P -> filterlim f F (locally P) ->
    filterlim (fun s => s_of (f s)) F (locally (s_of P)).
  Proof.
    intros [bounds dpos] lf. pose proof (sqrt_lt_R0 _ dpos).
    assert (half : filterlim (fun s => f s / 2 + 1) F (locally (P / 2 + 1))).
    { apply fl_plus; [|apply fl_const]. apply fl_mult; [exact lf|apply fl_const]. }
    unfold s_of. apply (fl_sqrt (fun s => (f s / 2 + 1 + sqrt (discriminant (f s))) / 6)); [lra|].
    apply fl_mult; [|apply fl_const]. apply fl_plus; [exact half|].
    apply fl_sqrt; [lra|apply fl_discriminant, lf].
  Qed.

  Lemma fl_curve_x (f : R -> R) P : reachable P -> filterlim f F (locally P) ->
    filterlim (fun s => curve_x (f s)) F (locally (curve_x P)).
  Proof.
    intros on lf. pose proof (fl_s_of f P on lf) as ls. pose proof (s_of_reachable P on) as ps.
    pose proof (c_pos _ (proper_inside _ ps)) as cpos. pose proof (proper_inside _ ps) as inside.
    unfold curve_x. apply fl_mult.
    - unfold m_of. apply fl_minus; [apply fl_scal, ls|]. exact (fl_derive w_of _ _ _ (is_derive_w _) ls).
    - exact (fl_derive c_of _ _ _ (is_derive_c _ inside) ls).
  Qed.

  Lemma fl_bearing : off_axis x0 y0 -> filterlim (fun s => bearing (x s) (y s)) F (locally (bearing x0 y0)).
  Proof.
    intros off. unfold off_axis, off_cut in off.
    assert (la : filterlim (fun s => ahead (x s) (y s)) F (locally (ahead x0 y0))).
    { unfold ahead. apply fl_plus; [apply fl_mult; [exact lx|apply fl_const]|].
      apply fl_scal, fl_minus; [exact ly|apply fl_const]. }
    assert (lb : filterlim (fun s => aside (x s) (y s)) F (locally (aside x0 y0))).
    { unfold aside. apply fl_plus; [apply fl_opp, fl_scal, lx|].
      apply fl_mult; [apply fl_minus; [exact ly|apply fl_const]|apply fl_const]. }
    unfold bearing, angle_of. apply fl_scal.
    apply (fl_derive atan (fun s => aside (x s) (y s) /
      (sqrt (ahead (x s) (y s) * ahead (x s) (y s) + aside (x s) (y s) * aside (x s) (y s)) + ahead (x s) (y s))) _ _
      (is_derive_atan _)).
    apply fl_mult; [exact lb|]. apply fl_inv; [lra|]. apply fl_plus; [|exact la].
    apply fl_sqrt; [nra|]. apply fl_plus; apply fl_mult; assumption.
  Qed.

  Lemma fl_time_rl : off_axis x0 y0 -> range_sq x0 y0 < 16 ->
    filterlim (fun s => time_rl (x s) (y s)) F (locally (time_rl x0 y0)).
  Proof.
    intros off inside. unfold time_rl. apply fl_plus; [apply fl_minus; [apply fl_const|apply fl_bearing, off]|].
    apply fl_scal. pose proof (range_range x0 y0). pose proof (sqrt_pos (range_sq x0 y0)) as r0.
    fold (range x0 y0) in r0. assert (bounds : -1 < range x0 y0 / 4 < 1) by (split; nra).
    apply (fl_derive asin (fun s => range (x s) (y s) / 4) _ _ (is_derive_asin _ bounds)).
    apply fl_mult; [|apply fl_const]. unfold range. apply fl_sqrt; [apply range_sq_nonneg|exact fl_range_sq].
  Qed.

  Lemma fl_time_rsl : off_axis x0 y0 -> 1 < range_sq x0 y0 ->
    filterlim (fun s => time_rsl (x s) (y s)) F (locally (time_rsl x0 y0)).
  Proof.
    intros off beyond. unfold time_rsl.
    assert (lc : filterlim (fun s => sqrt (range_sq (x s) (y s) - 1)) F (locally (sqrt (range_sq x0 y0 - 1)))).
    { apply fl_sqrt; [lra|]. apply fl_minus; [exact fl_range_sq|apply fl_const]. }
    pose proof (sqrt_lt_R0 (range_sq x0 y0 - 1) ltac:(lra)).
    apply fl_plus; [|apply fl_const]. apply fl_minus; [|apply fl_const]. apply fl_plus; [|exact lc].
    apply fl_plus; [apply fl_minus; [apply fl_const|apply fl_bearing, off]|].
    apply (fl_derive atan (fun s => / sqrt (range_sq (x s) (y s) - 1)) _ _ (is_derive_atan _)).
    apply fl_inv; [lra|exact lc].
  Qed.

  Lemma fl_outer_angle : off_cut (y0 + 1) x0 ->
    filterlim (fun s => outer_angle (x s) (y s)) F (locally (outer_angle x0 y0)).
  Proof.
    intros off. unfold off_cut in off. pose proof (fl_plus _ _ _ _ ly (fl_const 1)) as ly1.
    unfold outer_angle, angle_of. apply fl_scal.
    apply (fl_derive atan (fun s => x s / (sqrt ((y s + 1) * (y s + 1) + x s * x s) + (y s + 1))) _ _ (is_derive_atan _)).
    apply fl_mult; [exact lx|]. apply fl_inv; [lra|]. apply fl_plus; [|exact ly1].
    apply fl_sqrt; [|apply fl_plus; apply fl_mult; assumption].
    pose proof (pow2_ge_0 (y0 + 1)). pose proof (pow2_ge_0 x0). lra.
  Qed.

  Lemma fl_time_lrl : off_cut (y0 + 1) x0 -> reachable (outer_sq x0 y0) ->
    filterlim (fun s => time_lrl (x s) (y s)) F (locally (time_lrl x0 y0)).
  Proof.
    intros off on. unfold time_lrl. apply fl_minus; [|apply fl_outer_angle, off].
    apply (fl_derive arcs (fun s => s_of (outer_sq (x s) (y s))) _ _ (is_derive_arcs _ (s_of_reachable _ on))).
    apply fl_s_of; [exact on|exact fl_outer_sq].
  Qed.

  Lemma eventually_if (A : Prop) (Q : R -> Prop) : (A -> F Q) -> F (fun s => A -> Q s).
  Proof.
    intros H. destruct (Classical_Prop.classic A) as [yes|no].
    - apply (filter_imp Q); [intros s q _; exact q|exact (H yes)].
    - apply filter_forall. intros s a. contradiction.
  Qed.

  (** States close to a state that is not the target are near it. *)
  Lemma eventually_near : 0 <= y0 -> range_sq x0 y0 <> 0 -> F (fun s => 0 <= y s) ->
    F (fun s => near x0 y0 (x s) (y s)).
  Proof.
    intros up other ups. pose proof fl_range_sq as lr. pose proof fl_outer_sq as lo.
    pose proof (range_sq_nonneg x0 y0) as r0.
    assert (e1 : F (fun s => 0 < range_sq (x s) (y s))) by (apply (fl_above _ (range_sq x0 y0)); [lra|exact lr]).
    assert (e2 : F (fun s => 4 < range_sq x0 y0 -> 4 < range_sq (x s) (y s))).
    { apply eventually_if. intros h. exact (fl_above _ _ _ h lr). }
    assert (e3 : F (fun s => range_sq x0 y0 < 4 -> range_sq (x s) (y s) < 4)).
    { apply eventually_if. intros h. exact (fl_below _ _ _ h lr). }
    assert (e4 : F (fun s => 4 < outer_sq x0 y0 -> 4 < outer_sq (x s) (y s))).
    { apply eventually_if. intros h. exact (fl_above _ _ _ h lo). }
    assert (e5 : F (fun s => outer_sq x0 y0 < 4 -> outer_sq (x s) (y s) < 4)).
    { apply eventually_if. intros h. exact (fl_below _ _ _ h lo). }
    assert (gap : outer_sq x0 y0 < 4 -> filterlim (fun s => x s - curve_x (outer_sq (x s) (y s))) F
        (locally (x0 - curve_x (outer_sq x0 y0)))).
    { intros h. apply fl_minus; [exact lx|]. apply (fl_curve_x (fun s => outer_sq (x s) (y s))); [|exact lo].
      apply reachable_above. split; [apply outer_sq_above, up|exact h]. }
    assert (e6 : F (fun s => outer_sq x0 y0 < 4 -> x0 < curve_x (outer_sq x0 y0) ->
        x s - curve_x (outer_sq (x s) (y s)) < 0)).
    { apply eventually_if. intros h. apply eventually_if. intros lt. apply (fl_below _ (x0 - curve_x (outer_sq x0 y0))); [lra|exact (gap h)]. }
    assert (e7 : F (fun s => outer_sq x0 y0 < 4 -> curve_x (outer_sq x0 y0) < x0 ->
        0 < x s - curve_x (outer_sq (x s) (y s)))).
    { apply eventually_if. intros h. apply eventually_if. intros lt. apply (fl_above _ (x0 - curve_x (outer_sq x0 y0))); [lra|exact (gap h)]. }
    assert (e8 : F (fun s => outer_sq x0 y0 = 4 -> 0 < x0 -> x0 / 2 < x s /\ 4 - x0 * x0 / 2 < outer_sq (x s) (y s))).
    { apply eventually_if. intros h. apply eventually_if. intros pos. apply filter_and.
      - apply (fl_above _ x0); [lra|exact lx].
      - apply (fl_above _ (outer_sq x0 y0)); [nra|exact lo]. }
    generalize (filter_and _ _ ups (filter_and _ _ e1 (filter_and _ _ e2 (filter_and _ _ e3 (filter_and _ _ e4
      (filter_and _ _ e5 (filter_and _ _ e6 (filter_and _ _ e7 e8)))))))).
    apply filter_imp. intros s (ys & h1 & h2 & h3 & h4 & h5 & h6 & h7 & h8). constructor.
    - lra.
    - exact h2.
    - exact h3.
    - exact h4.
    - exact h5.
    - intros a b. specialize (h6 a b). lra.
    - intros a b. specialize (h7 a b). lra.
    - intros a b [inside before]. destruct (h8 a b) as [hx ho].
      assert (bounds : 1 <= outer_sq (x s) (y s) < 4) by (split; [apply outer_sq_above, ys|exact inside]).
      pose proof (curve_narrow _ bounds). pose proof (curve_x_nonneg _ bounds).
      set (e := curve_x (outer_sq (x s) (y s))) in *.
      assert (x0 / 2 * (x0 / 2) < e * e) by (apply Rmult_le_0_lt_compat; lra). lra.
  Qed.
End Along.

(** ** The four cases *)

(** Near a state that is not the target its own formula gives the least time, except across the last arc. *)
Lemma cases x y x' y' : 0 <= y -> 0 <= y' -> range_sq x y <> 0 -> near x y x' y' ->
  (4 <= range_sq x y /\ least_time_up x y = time_rsl x y /\ least_time_up x' y' = time_rsl x' y')
  \/ (left_first x y /\ least_time_up x y = time_lrl x y /\ least_time_up x' y' = time_lrl x' y')
  \/ (off_axis x y /\ range_sq x y <= 4 /\ 0 <= rl_margin x y
      /\ least_time_up x y = time_rl x y /\ least_time_up x' y' = time_rl x' y')
  \/ (outer_sq x y = 4 /\ x < 0 /\ least_time_up x y <= PI / 2 /\ left_first x' y'
      /\ least_time_up x' y' = time_lrl x' y').
Proof.
  intros up up' other nr. destruct nr as [nt fr cl ou wi bc ac eoc].
  assert (value' : least_time_up x' y' = if Rle_dec 4 (range_sq x' y') then time_rsl x' y'
      else if left_first_dec x' y' then time_lrl x' y' else time_rl x' y').
  { unfold least_time_up. destruct (Req_EM_T _ _); [contradiction|reflexivity]. }
  assert (value : least_time_up x y = if Rle_dec 4 (range_sq x y) then time_rsl x y
      else if left_first_dec x y then time_lrl x y else time_rl x y).
  { unfold least_time_up. destruct (Req_EM_T _ _); [contradiction|reflexivity]. }
  pose proof (outer_range x y) as oxy.
  destruct (Rle_dec 4 (range_sq x' y')) as [far'|near'].
  - left. assert (f : 4 <= range_sq x y) by (apply Rnot_lt_le; intros lt; specialize (cl lt); lra).
    split; [exact f|split; [|exact value']]. rewrite value. destruct (Rle_dec 4 _); [reflexivity|contradiction].
  - assert (n : range_sq x y <= 4) by (apply Rnot_lt_le; intros lt; specialize (fr lt); lra).
    destruct (left_first_dec x' y') as [lf'|nlf'].
    + destruct lf' as [in' before'].
      assert (le : outer_sq x y <= 4) by (apply Rnot_lt_le; intros lt; specialize (ou lt); lra).
      destruct (Rle_lt_or_eq_dec _ _ le) as [inside|on].
      * right; left. assert (lf : left_first x y).
        { split; [exact inside|]. apply Rnot_lt_le. intros lt. specialize (ac inside lt). lra. }
        split; [exact lf|split; [|exact value']]. rewrite value.
        destruct (Rle_dec 4 _) as [f|_]; [exfalso; lra|]. destruct (left_first_dec x y); [reflexivity|contradiction].
      * right; right; right. assert (left : x < 0).
        { apply Rnot_le_lt. intros [pos|zero]; [apply (eoc on pos); split; assumption|].
          apply other. unfold outer_sq, range_sq in *. rewrite <- zero in *.
          assert (y = 1) by nra. subst y. ring. }
        repeat split; try assumption.
        pose proof (time_rl_on_last_arc x y up other n on left) as bound.
        rewrite value. destruct (Rle_dec 4 (range_sq x y)) as [f|_].
        { rewrite times_at_two by lra. exact bound. }
        destruct (left_first_dec x y) as [[lt _]|_]; [lra|exact bound].
    + right; right; left.
      assert (rl_here : off_axis x y /\ 0 <= rl_margin x y).
      { destruct (Rlt_dec (outer_sq x y) 4) as [inside|beyond].
        - assert (after : curve_x (outer_sq x y) <= x).
          { apply Rnot_lt_le. intros lt. apply nlf'. split; [exact (wi inside)|].
            left. exact (bc inside lt). }
          split; [exact (off_axis_curve x y up inside after)|exact (rl_margin_right x y up inside after)].
        - split; [apply off_axis_outside; (assumption || lra)|apply rl_margin_outside; [unfold outer_sq in beyond; lra|exact n]]. }
      destruct rl_here as [off margin]. repeat split; try assumption.
      rewrite value. destruct (Rle_dec 4 (range_sq x y)) as [f|_]; [apply times_at_two; lra|].
      destruct (left_first_dec x y) as [[inside before]|_]; [|reflexivity].
      apply times_on_curve; [exact up|exact inside|].
      destruct before as [lt|eq]; [|exact eq]. exfalso. apply nlf'. split; [exact (wi inside)|].
      left. exact (bc inside lt).
Qed.
