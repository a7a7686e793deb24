(** The reduced motion of a Dubins vehicle about the centre of its holding circle, right derivatives along it, and the
    principle by which a lower bound on the time of arrival is proved: a function that never falls faster than time
    passes. *)

Require Import Reals Lra Classical.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** * Right derivatives *)

(** [f] has the right derivative [l] at [t]. *)
Definition right_derive (f : R -> R) (t l : R) : Prop :=
  forall eps, 0 < eps -> exists delta, 0 < delta /\
    forall s, t < s < t + delta -> Rabs (f s - f t - l * (s - t)) <= eps * (s - t).

Lemma rd_ext f g t l : (forall s, t <= s -> f s = g s) -> right_derive f t l -> right_derive g t l.
Proof.
  intros same rf eps pos. destruct (rf eps pos) as [d [dpos H]]. exists d. split; [exact dpos|].
  intros s near. rewrite <- !same by lra. exact (H s near).
Qed.

Lemma rd_const c t : right_derive (fun _ => c) t 0.
Proof.
  intros eps pos. exists 1. split; [lra|]. intros s near.
  replace (c - c - 0 * (s - t)) with 0 by ring. rewrite Rabs_R0. nra.
Qed.

Lemma rd_id t : right_derive (fun s => s) t 1.
Proof.
  intros eps pos. exists 1. split; [lra|]. intros s near.
  replace (s - t - 1 * (s - t)) with 0 by ring. rewrite Rabs_R0. nra.
Qed.

Lemma rd_plus f g t l m : right_derive f t l -> right_derive g t m -> right_derive (fun s => f s + g s) t (l + m).
Proof.
  intros rf rg eps pos.
  destruct (rf (eps / 2)) as [d [dpos Hf]]; [lra|]. destruct (rg (eps / 2)) as [e [epos Hg]]; [lra|].
  exists (Rmin d e). split; [apply Rmin_pos; assumption|]. intros s near.
  assert (Rmin d e <= d) by apply Rmin_l. assert (Rmin d e <= e) by apply Rmin_r.
  specialize (Hf s ltac:(lra)). specialize (Hg s ltac:(lra)).
  replace (f s + g s - (f t + g t) - (l + m) * (s - t))
    with ((f s - f t - l * (s - t)) + (g s - g t - m * (s - t))) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

(** A function with a right derivative changes at most at a bounded rate. *)
Lemma rd_bounded_rate f t l : right_derive f t l ->
  exists delta, 0 < delta /\ forall s, t < s < t + delta -> Rabs (f s - f t) <= (Rabs l + 1) * (s - t).
Proof.
  intros rf. destruct (rf 1) as [d [dpos H]]; [lra|]. exists d. split; [exact dpos|]. intros s near.
  specialize (H s near).
  replace (f s - f t) with ((f s - f t - l * (s - t)) + l * (s - t)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult, (Rabs_right (s - t)); lra.
Qed.

(** The chain rule; the outer function has a two-sided derivative. *)
Lemma rd_comp g f t k l : is_derive g (f t) k -> right_derive f t l -> right_derive (fun s => g (f s)) t (k * l).
Proof.
  intros dg rf eps pos. apply is_derive_Reals in dg.
  destruct (rd_bounded_rate _ _ _ rf) as [d1 [d1pos rate]].
  set (K := Rabs l + 1) in *. assert (Kpos : 0 < K) by (unfold K; pose proof (Rabs_pos l); lra).
  set (Q := Rabs k + 1). assert (Qpos : 0 < Q) by (unfold Q; pose proof (Rabs_pos k); lra).
  destruct (dg (eps / (2 * K))) as [[d2 d2pos] Hg]; [apply Rdiv_lt_0_compat; lra|]. simpl in Hg.
  destruct (rf (eps / (2 * Q))) as [d3 [d3pos Hf]]; [apply Rdiv_lt_0_compat; lra|].
  exists (Rmin (Rmin d1 d3) (d2 / K)).
  assert (0 < d2 / K) by (apply Rdiv_lt_0_compat; lra).
  split; [do 2 (try apply Rmin_pos); assumption|]. intros s near.
  assert (Rmin (Rmin d1 d3) (d2 / K) <= d2 / K) by apply Rmin_r.
  assert (Rmin (Rmin d1 d3) (d2 / K) <= Rmin d1 d3) by apply Rmin_l.
  assert (Rmin d1 d3 <= d1) by apply Rmin_l. assert (Rmin d1 d3 <= d3) by apply Rmin_r.
  specialize (rate s ltac:(lra)). specialize (Hf s ltac:(lra)).
  set (h := f s - f t) in *.
  assert (small : Rabs h < d2).
  { eapply Rle_lt_trans; [exact rate|]. apply Rlt_le_trans with (K * (d2 / K)).
    - apply Rmult_lt_compat_l; lra.
    - right. field. lra. }
  assert (outer : Rabs (g (f s) - g (f t) - k * h) <= eps / (2 * K) * Rabs h).
  { destruct (Req_dec h 0) as [zero|differ].
    - replace (f s) with (f t) by (unfold h in zero; lra). rewrite zero, Rabs_R0.
      replace (g (f t) - g (f t) - k * 0) with 0 by ring. rewrite Rabs_R0. lra.
    - specialize (Hg h differ small). assert (moved : f t + h = f s) by (unfold h; ring). rewrite moved in Hg.
      replace (g (f s) - g (f t) - k * h) with (((g (f s) - g (f t)) / h - k) * h) by (field; exact differ).
      rewrite Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|lra]. }
  replace (g (f s) - g (f t) - k * l * (s - t))
    with ((g (f s) - g (f t) - k * h) + k * (h - l * (s - t))) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult.
  assert (eps / (2 * K) * Rabs h <= eps / 2 * (s - t)).
  { apply Rle_trans with (eps / (2 * K) * (K * (s - t))).
    - apply Rmult_le_compat_l; [left; apply Rdiv_lt_0_compat; lra|exact rate].
    - right. field. lra. }
  assert (Rabs k * Rabs (h - l * (s - t)) <= eps / 2 * (s - t)).
  { apply Rle_trans with (Q * (eps / (2 * Q) * (s - t))).
    - apply Rmult_le_compat; [apply Rabs_pos|apply Rabs_pos|unfold Q; lra|unfold h; exact Hf].
    - right. field. lra. }
  lra.
Qed.

Lemma rd_scal c f t l : right_derive f t l -> right_derive (fun s => c * f s) t (c * l).
Proof. apply (rd_comp (fun v => c * v)). auto_derive; [exact I|ring]. Qed.

Lemma rd_opp f t l : right_derive f t l -> right_derive (fun s => - f s) t (- l).
Proof.
  intros rf. replace (- l) with (-1 * l) by ring.
  apply (rd_ext (fun s => -1 * f s)); [intros; ring|]. apply rd_scal, rf.
Qed.

Lemma rd_minus f g t l m : right_derive f t l -> right_derive g t m -> right_derive (fun s => f s - g s) t (l - m).
Proof. intros rf rg. apply rd_plus; [exact rf|apply rd_opp, rg]. Qed.

Lemma rd_square f t l : right_derive f t l -> right_derive (fun s => f s * f s) t (2 * f t * l).
Proof. apply (rd_comp (fun v => v * v)). auto_derive; [exact I|ring]. Qed.

Lemma rd_mult f g t l m :
  right_derive f t l -> right_derive g t m -> right_derive (fun s => f s * g s) t (l * g t + f t * m).
Proof.
  intros rf rg.
  apply (rd_ext (fun s => (f s + g s) * (f s + g s) * / 4 - (f s - g s) * (f s - g s) * / 4)); [intros; field|].
  replace (l * g t + f t * m)
    with (/ 4 * (2 * (f t + g t) * (l + m)) - / 4 * (2 * (f t - g t) * (l - m))) by field.
  apply rd_minus.
  - apply (rd_ext (fun s => / 4 * ((f s + g s) * (f s + g s)))); [intros; ring|].
    apply rd_scal, (rd_square (fun s => f s + g s)), rd_plus; assumption.
  - apply (rd_ext (fun s => / 4 * ((f s - g s) * (f s - g s)))); [intros; ring|].
    apply rd_scal, (rd_square (fun s => f s - g s)), rd_minus; assumption.
Qed.

Lemma rd_unique f t l m : right_derive f t l -> right_derive f t m -> l = m.
Proof.
  intros rl rm. destruct (Req_dec l m) as [same|differ]; [exact same|exfalso].
  assert (pos : 0 < Rabs (l - m)) by (apply Rabs_pos_lt; lra).
  destruct (rl (Rabs (l - m) / 4)) as [d [dpos Hl]]; [lra|].
  destruct (rm (Rabs (l - m) / 4)) as [e [epos Hm]]; [lra|].
  assert (0 < Rmin d e) by (apply Rmin_pos; assumption).
  assert (Rmin d e <= d) by apply Rmin_l. assert (Rmin d e <= e) by apply Rmin_r.
  set (s := t + Rmin d e / 2).
  specialize (Hl s ltac:(unfold s; lra)). specialize (Hm s ltac:(unfold s; lra)).
  assert (Rabs ((l - m) * (s - t)) <= Rabs (l - m) / 2 * (s - t)).
  { replace ((l - m) * (s - t)) with ((f s - f t - m * (s - t)) - (f s - f t - l * (s - t))) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  rewrite Rabs_mult, (Rabs_right (s - t)) in H2 by (unfold s; lra).
  assert (0 < s - t) by (unfold s; lra). nra.
Qed.

(** * Continuity from the left *)

Definition left_continuous (f : R -> R) (t : R) : Prop := filterlim f (at_left t) (locally (f t)).

Lemma lc_epsilon f t : left_continuous f t ->
  forall eps, 0 < eps -> exists delta, 0 < delta /\ forall s, t - delta < s < t -> Rabs (f s - f t) < eps.
Proof.
  intros lc eps pos. destruct (lc (ball (f t) (mkposreal eps pos))) as [[d dpos] H].
  { exists (mkposreal eps pos). intros v near. exact near. }
  exists d. split; [exact dpos|]. intros s near. apply (H s); [|lra].
  change (Rabs (s - t) < d). rewrite Rabs_left1; lra.
Qed.

Lemma epsilon_lc f t :
  (forall eps, 0 < eps -> exists delta, 0 < delta /\ forall s, t - delta < s < t -> Rabs (f s - f t) < eps) ->
  left_continuous f t.
Proof.
  intros H P [[e epos] HP]. destruct (H e epos) as [d [dpos close]].
  exists (mkposreal d dpos). intros s near before. apply HP, close.
  change (Rabs (s - t) < d) in near. apply Rabs_lt_between in near. lra.
Qed.

Lemma lc_id t : filterlim (fun s : R => s) (at_left t) (locally t).
Proof. intros P [e H]. exists e. intros s near _. exact (H s near). Qed.

Lemma rd_right_continuous f t l : right_derive f t l -> filterlim f (at_right t) (locally (f t)).
Proof.
  intros rf P [[e epos] HP]. destruct (rd_bounded_rate _ _ _ rf) as [d [dpos rate]].
  set (K := Rabs l + 1) in *. assert (Kpos : 0 < K) by (unfold K; pose proof (Rabs_pos l); lra).
  assert (0 < e / K) by (apply Rdiv_lt_0_compat; lra).
  exists (mkposreal (Rmin d (e / K)) (Rmin_pos _ _ dpos H)). intros s near after. apply HP.
  change (Rabs (s - t) < Rmin d (e / K)) in near. apply Rabs_lt_between in near.
  pose proof (Rmin_l d (e / K)). pose proof (Rmin_r d (e / K)).
  change (Rabs (f s - f t) < e). eapply Rle_lt_trans; [apply rate; lra|].
  apply Rlt_le_trans with (K * (e / K)); [apply Rmult_lt_compat_l; lra|]. right. field. lra.
Qed.

(** ** Limits along a filter: from the left, or from the right. *)
Section Along.
  Context {F : (R -> Prop) -> Prop} {FF : Filter F}.

  Lemma fl_comp (g f : R -> R) v : continuous g v -> filterlim f F (locally v) ->
    filterlim (fun s => g (f s)) F (locally (g v)).
  Proof. intros cont lf. exact (filterlim_comp _ _ _ f g _ _ _ lf cont). Qed.

  Lemma fl_derive (g f : R -> R) (v l : R) : is_derive g v l -> filterlim f F (locally v) ->
    filterlim (fun s => g (f s)) F (locally (g v)).
  Proof. intros dg. apply fl_comp, (ex_derive_continuous g v). exists l. exact dg. Qed.

  Lemma fl_const (c : R) : filterlim (fun _ : R => c) F (locally c).
  Proof. apply filterlim_const. Qed.

  Lemma fl_plus f g v w : filterlim f F (locally v) -> filterlim g F (locally w) ->
    filterlim (fun s => f s + g s) F (locally (v + w)).
  Proof. intros lf lg. apply (filterlim_comp_2 f g Rplus) with (1 := lf) (2 := lg). exact (filterlim_plus v w). Qed.

  Lemma fl_mult f g v w : filterlim f F (locally v) -> filterlim g F (locally w) ->
    filterlim (fun s => f s * g s) F (locally (v * w)).
  Proof. intros lf lg. apply (filterlim_comp_2 f g Rmult) with (1 := lf) (2 := lg). exact (filterlim_mult v w). Qed.

  Lemma fl_scal c f v : filterlim f F (locally v) -> filterlim (fun s => c * f s) F (locally (c * v)).
  Proof. apply fl_mult, fl_const. Qed.

  Lemma fl_opp f v : filterlim f F (locally v) -> filterlim (fun s => - f s) F (locally (- v)).
  Proof. apply fl_comp, (ex_derive_continuous Ropp). auto_derive. exact I. Qed.

  Lemma fl_minus f g v w : filterlim f F (locally v) -> filterlim g F (locally w) ->
    filterlim (fun s => f s - g s) F (locally (v - w)).
  Proof. intros lf lg. apply fl_plus; [exact lf|apply fl_opp, lg]. Qed.

  Lemma fl_inv f v : v <> 0 -> filterlim f F (locally v) -> filterlim (fun s => / f s) F (locally (/ v)).
  Proof. intros differ. apply fl_comp, (ex_derive_continuous Rinv). auto_derive. exact differ. Qed.

  Lemma fl_sqrt f v : 0 <= v -> filterlim f F (locally v) -> filterlim (fun s => sqrt (f s)) F (locally (sqrt v)).
  Proof. intros nonneg. apply fl_comp, continuity_pt_filterlim, continuity_pt_sqrt, nonneg. Qed.

  Lemma fl_below (f : R -> R) (v k : R) : v < k -> filterlim f F (locally v) -> F (fun s => f s < k).
  Proof. intros below lf. exact (lf _ (open_lt k v below)). Qed.

  Lemma fl_above (f : R -> R) (v k : R) : k < v -> filterlim f F (locally v) -> F (fun s => k < f s).
  Proof. intros above lf. exact (lf _ (open_gt k v above)). Qed.
End Along.

Lemma rd_of_derive f t l : is_derive f t l -> right_derive f t l.
Proof.
  intros df. pose proof (rd_comp f (fun s => s) t l 1 df (rd_id t)) as rd. rewrite Rmult_1_r in rd. exact rd.
Qed.

Lemma lc_of_derive f t l : is_derive f t l -> left_continuous f t.
Proof. intros df. exact (fl_derive f (fun s => s) t l df (lc_id t)). Qed.

(** * Trajectories *)

(** A point of the reduced plane moves with [x' = 1 + u y], [y' = - u x] under a control [|u| <= 1]. Controls that are
    piecewise continuous, taken continuous from the right, give such trajectories. *)
Record trajectory (x y u : R -> R) (tau : R) : Prop := {
  duration_nonneg : 0 <= tau;
  control_bounded : forall t, 0 <= t < tau -> -1 <= u t <= 1;
  x_continuous : forall t, 0 < t <= tau -> left_continuous x t;
  y_continuous : forall t, 0 < t <= tau -> left_continuous y t;
  x_moves : forall t, 0 <= t < tau -> right_derive x t (1 + u t * y t);
  y_moves : forall t, 0 <= t < tau -> right_derive y t (- (u t * x t))
}.

(** The heading [th], from 0 at first, turns at the rate [u]. *)
Definition turns (th u : R -> R) (tau : R) : Prop :=
  th 0 = 0 /\ (forall t, 0 < t <= tau -> left_continuous th t)
  /\ (forall t, 0 <= t < tau -> right_derive th t (u t)).

(** * Functions that do not fall *)

(** A function that, to the right of each point, falls at no positive rate, and that does not drop below its values
    from the left, ends no lower than it begins. *)
Lemma never_falls (f : R -> R) (a b : R) :
  a <= b ->
  (forall t, a <= t < b -> forall eps, 0 < eps ->
    exists delta, 0 < delta /\ forall s, t < s < t + delta -> s <= b -> f t - eps * (s - t) <= f s) ->
  (forall t, a < t <= b -> forall eps, 0 < eps ->
    exists delta, 0 < delta /\ forall s, t - delta < s < t -> a <= s -> f s <= f t + eps) ->
  f a <= f b.
Proof.
  intros ab right left.
  assert (loose : forall eps, 0 < eps -> f a - eps * (b - a) <= f b).
  { intros eps pos.
    set (S := fun t => a <= t <= b /\ f a - eps * (t - a) <= f t).
    destruct (completeness S) as [c [upper least]].
    { exists b; intros t [[_ tb] _]; exact tb. }
    { exists a; split; lra. }
    assert (ac : a <= c) by (apply upper; split; lra).
    assert (cb : c <= b) by (apply least; intros t [[_ tb] _]; exact tb).
    assert (in_S : S c).
    { destruct (classic (S c)) as [yes|no]; [exact yes|].
      assert (differ : a <> c) by (intros <-; apply no; split; lra).
      split; [lra|]. apply Rnot_lt_le. intros low.
      destruct (left c ltac:(lra) ((f a - eps * (c - a) - f c) / 2)) as [d [dpos H]]; [lra|].
      destruct (classic (exists s, S s /\ c - d < s)) as [[s [inside near]]|none].
      - assert (s <= c) by (apply upper; exact inside).
        assert (s <> c) by (intros ->; contradiction).
        destruct inside as [[as_ _] high]. specialize (H s ltac:(lra) as_). nra.
      - assert (c <= c - d); [|lra].
        apply least. intros s inside. apply Rnot_lt_le. intros near. apply none. exists s. split; assumption. }
    destruct (Req_dec c b) as [<-|differ]; [destruct in_S; lra|].
    destruct (right c ltac:(lra) eps pos) as [d [dpos H]].
    exfalso. pose proof (Rmin_l (d / 2) (b - c)). pose proof (Rmin_r (d / 2) (b - c)).
    assert (0 < Rmin (d / 2) (b - c)) by (apply Rmin_pos; lra).
    set (s := c + Rmin (d / 2) (b - c)).
    assert (s <= c); [|unfold s in *; lra].
    apply upper. destruct in_S as [_ low]. specialize (H s ltac:(unfold s; lra) ltac:(unfold s; lra)).
    split; unfold s in *; nra. }
  apply Rnot_lt_le. intros lower.
  destruct (Req_dec a b) as [->|differ]; [lra|].
  specialize (loose ((f a - f b) / (2 * (b - a)))).
  assert (0 < (f a - f b) / (2 * (b - a))) by (apply Rdiv_lt_0_compat; lra).
  assert ((f a - f b) / (2 * (b - a)) * (b - a) = (f a - f b) / 2) by (field; lra).
  lra.
Qed.

(** A continuous function whose right derivatives are at least [0] does not fall. *)
Lemma never_falls_continuous (f : R -> R) (a b : R) :
  a <= b -> (forall t, a < t <= b -> left_continuous f t) ->
  (forall t, a <= t < b -> exists l, 0 <= l /\ right_derive f t l) -> f a <= f b.
Proof.
  intros ab cont deriv. apply never_falls; [exact ab| |].
  - intros t inside eps pos. destruct (deriv t inside) as [l [lpos rd]].
    destruct (rd eps pos) as [d [dpos H]]. exists d. split; [exact dpos|]. intros s near _.
    specialize (H s near). apply Rabs_le_between in H. nra.
  - intros t inside eps pos. destruct (lc_epsilon _ _ (cont t inside) eps pos) as [d [dpos H]].
    exists d. split; [exact dpos|]. intros s near _. specialize (H s near). apply Rabs_lt_between in H. lra.
Qed.
