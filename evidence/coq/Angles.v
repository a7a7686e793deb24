(** The angle of a vector, and how it changes. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion.
Open Scope R_scope.

(** The angle of the vector [(p, n)] from its first axis, counter-clockwise, in [(-PI, PI)]; continuous except on the
    negative half of that axis. *)
Definition angle_of (p n : R) : R := 2 * atan (n / (sqrt (p * p + n * n) + p)).

(** The vector is not on the negative half of the first axis, and is not 0. *)
Definition off_cut (p n : R) : Prop := 0 < sqrt (p * p + n * n) + p.

Lemma length_sq p n : sqrt (p * p + n * n) * sqrt (p * p + n * n) = p * p + n * n.
Proof. apply sqrt_sqrt. nra. Qed.

Lemma off_cut_length p n : off_cut p n -> 0 < sqrt (p * p + n * n).
Proof.
  unfold off_cut. intros off. pose proof (sqrt_pos (p * p + n * n)). pose proof (length_sq p n).
  destruct (Req_dec (sqrt (p * p + n * n)) 0) as [zero|differ]; [|lra].
  rewrite zero in *. assert (p * p + n * n = 0) by lra. assert (p = 0) by nra. lra.
Qed.

Lemma off_cut_intro p n : 0 < p \/ n <> 0 -> off_cut p n.
Proof.
  unfold off_cut. intros [pos|differ]; pose proof (sqrt_pos (p * p + n * n)); [lra|].
  pose proof (length_sq p n). assert (0 < n * n) by nra. nra.
Qed.

Lemma angle_of_bounds p n : - PI < angle_of p n < PI.
Proof. unfold angle_of. pose proof (atan_bound (n / (sqrt (p * p + n * n) + p))). lra. Qed.

Lemma cos_sin_angle_of p n : off_cut p n ->
  sqrt (p * p + n * n) * cos (angle_of p n) = p /\ sqrt (p * p + n * n) * sin (angle_of p n) = n.
Proof.
  intros off. pose proof (off_cut_length p n off) as rpos. pose proof (length_sq p n) as rr.
  unfold off_cut, angle_of in *. set (r := sqrt (p * p + n * n)) in *. set (k := n / (r + p)).
  assert (kk : 1 + k * k = 2 * r / (r + p)).
  { unfold k. apply Rmult_eq_reg_r with ((r + p) * (r + p)); [|nra]. field_simplify; [|lra|lra]. nra. }
  assert (cc : cos (atan k) * cos (atan k) = (r + p) / (2 * r)).
  { rewrite cos_atan. unfold Rsqr. rewrite kk.
    assert (0 < 2 * r / (r + p)) by (apply Rdiv_lt_0_compat; lra).
    assert (sq := sqrt_sqrt (2 * r / (r + p)) ltac:(lra)).
    assert (sp := sqrt_lt_R0 (2 * r / (r + p)) ltac:(lra)).
    set (w := sqrt (2 * r / (r + p))) in *.
    replace (1 / w * (1 / w)) with (1 / (w * w)) by (field; lra). rewrite sq. field. lra. }
  assert (sc : sin (atan k) = k * cos (atan k)) by (rewrite sin_atan, cos_atan; field; apply Rgt_not_eq, sqrt_lt_R0; unfold Rsqr; nra).
  rewrite cos_2a_cos, sin_2a, sc. split.
  - rewrite Rmult_assoc, cc. field. lra.
  - replace (r * (2 * (k * cos (atan k)) * cos (atan k))) with (r * 2 * k * (cos (atan k) * cos (atan k))) by ring.
    rewrite cc. unfold k. field. lra.
Qed.

(** Two angles that differ by less than a whole turn and point the same way are equal. *)
Lemma same_angle a b : Rabs (a - b) < 2 * PI -> cos a = cos b -> sin a = sin b -> a = b.
Proof.
  intros near ec es. assert (one : cos (a - b) = 1).
  { rewrite cos_minus, ec, es. pose proof (sin2_cos2 b). unfold Rsqr in *. lra. }
  assert (half : sin ((a - b) / 2) = 0).
  { replace (a - b) with (2 * ((a - b) / 2)) in one by field. rewrite cos_2a_sin in one. nra. }
  apply Rabs_lt_between in near.
  destruct (Rtotal_order ((a - b) / 2) 0) as [neg|[zero|pos]]; [exfalso|lra|exfalso].
  - pose proof (sin_lt_0_var ((a - b) / 2)). lra.
  - pose proof (sin_gt_0 ((a - b) / 2)). lra.
Qed.

(** A vector turns at the rate (its moment of velocity) / (its squared length). *)

Lemma is_derive_sqrt q : 0 < q -> is_derive sqrt q (/ (2 * sqrt q)).
Proof. intros pos. apply is_derive_Reals, derivable_pt_lim_sqrt, pos. Qed.

Lemma is_derive_atan k : is_derive atan k (/ (1 + k * k)).
Proof. auto_derive; [exact I|]. unfold Rsqr. field. nra. Qed.

Lemma rd_sqrt q t q' : 0 < q t -> right_derive q t q' -> right_derive (fun s => sqrt (q s)) t (q' / (2 * sqrt (q t))).
Proof.
  intros pos rq. replace (q' / (2 * sqrt (q t))) with (/ (2 * sqrt (q t)) * q').
  - apply (rd_comp sqrt); [apply is_derive_sqrt, pos|exact rq].
  - field. apply Rgt_not_eq, sqrt_lt_R0, pos.
Qed.

Lemma rd_atan k t k' : right_derive k t k' -> right_derive (fun s => atan (k s)) t (k' / (1 + k t * k t)).
Proof.
  intros rk. replace (k' / (1 + k t * k t)) with (/ (1 + k t * k t) * k') by (field; nra).
  apply (rd_comp atan); [apply is_derive_atan|exact rk].
Qed.

Lemma rd_div f g t f' g' : g t <> 0 -> right_derive f t f' -> right_derive g t g' ->
  right_derive (fun s => f s / g s) t ((f' * g t - f t * g') / (g t * g t)).
Proof.
  intros differ rf rg. replace ((f' * g t - f t * g') / (g t * g t)) with (f' * / g t + f t * (- / (g t * g t) * g')).
  - apply (rd_mult f (fun s => / g s)); [exact rf|]. apply (rd_comp Rinv g); [|exact rg].
    apply (is_derive_ext (fun v => / v)); [reflexivity|]. auto_derive; [exact differ|]. field. exact differ.
  - field. exact differ.
Qed.

Lemma rd_angle_of p n t p' n' : off_cut (p t) (n t) -> right_derive p t p' -> right_derive n t n' ->
  right_derive (fun s => angle_of (p s) (n s)) t ((p t * n' - n t * p') / (p t * p t + n t * n t)).
Proof.
  intros off rp rn. pose proof (off_cut_length _ _ off) as rpos. pose proof (length_sq (p t) (n t)) as rr.
  unfold off_cut in off.
  assert (qpos : 0 < p t * p t + n t * n t) by nra.
  pose proof (rd_sqrt (fun s => p s * p s + n s * n s) t _ qpos
    (rd_plus _ _ _ _ _ (rd_square _ _ _ rp) (rd_square _ _ _ rn))) as rl. simpl in rl.
  pose proof (rd_div n (fun s => sqrt (p s * p s + n s * n s) + p s) t _ _ (Rgt_not_eq _ _ off) rn
    (rd_plus _ _ _ _ _ rl rp)) as rk. simpl in rk.
  pose proof (rd_scal 2 _ _ _ (rd_atan _ _ _ rk)) as ra. simpl in ra. unfold angle_of.
  set (r := sqrt (p t * p t + n t * n t)) in *. set (P := p t) in *. set (N := n t) in *.
  match type of ra with right_derive _ _ ?v => replace ((P * n' - N * p') / (P * P + N * N)) with v; [exact ra|] end.
  rewrite <- rr.
  assert (one : 1 + N / (r + P) * (N / (r + P)) = 2 * r / (r + P)).
  { apply Rmult_eq_reg_r with ((r + P) * (r + P)); [|nra]. field_simplify; [|lra|lra]. nra. }
  rewrite one.
  apply Rmult_eq_reg_r with (r * r * (r + P)); [|apply Rgt_not_eq; repeat apply Rmult_lt_0_compat; lra].
  field_simplify; [|lra|lra].
  replace (N ^ 2) with (r * r - P * P) by (simpl; lra).
  nra.
Qed.
