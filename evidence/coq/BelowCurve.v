(** Below the axis, on the left, LRL is flown where RL with the left crossing can be improved, and a little beyond. *)

Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Loiter Require Import Motion Angles RightFirst LeftFirst Nearby Below.
Open Scope R_scope.

(** ** Where RL can be improved, LRL is sooner *)

Lemma discriminant_of_tangency P y : 0 <= P -> P < 4 -> 0 < tangency P y -> reachable P.
Proof.
  intros P0 P4 pos. assert (D : 0 < discriminant P).
  { assert (64 * discriminant P = 96 * tangency P y + (48 * (y - 1) - (10 * P - 64)) * (48 * (y - 1) - (10 * P - 64)))
      by (unfold discriminant, tangency; field).
    pose proof (pow2_ge_0 (48 * (y - 1) - (10 * P - 64))). lra. }
  split; [|exact D]. split; [|exact P4]. destruct P0 as [lt|<-]; [exact lt|]. unfold discriminant in D. lra.
Qed.

(** Cosines and the ordinates of points of a circle. *)
Lemma scaled_lt h c c' : 0 < h -> c < c' -> h * c < h * c'.
Proof. intros. apply Rmult_lt_compat_l; assumption. Qed.

Lemma scaled_le h c c' : 0 < h -> c <= c' -> h * c <= h * c'.
Proof. intros. apply Rmult_le_compat_l; lra. Qed.

Lemma cos_rises a b : - PI <= a -> a < b -> b <= 0 -> cos a < cos b.
Proof.
  intros. rewrite <- (cos_neg a), <- (cos_neg b). apply cos_decreasing_1; lra.
Qed.

Lemma cos_rises_le a b : - PI <= a -> a <= b -> b <= 0 -> cos a <= cos b.
Proof. intros low [lt|<-] up; [left; apply cos_rises; assumption|apply Rle_refl]. Qed.

Lemma outer_sq_nonneg x y : 0 <= outer_sq x y.
Proof. unfold outer_sq. pose proof (pow2_ge_0 x). pose proof (pow2_ge_0 (y + 1)). lra. Qed.

Section Improved.
  Variables x y : R.
  Hypothesis left : x < 0.
  Let P := outer_sq x y.
  Hypothesis inside : P < 4.
  Hypothesis improved : 0 < tangency P y.

  Lemma improved_before : left_below x y.
  Proof.
    assert (on : reachable P).
    { apply (discriminant_of_tangency P y); [apply outer_sq_nonneg|exact inside|exact improved]. }
    split; [exact left|split; [exact on|]]. fold P.
    destruct (outer_polar x y (off_cut_left x y left)) as (sa & ca & hpos). pose proof (outer_angle_left x y left) as ab.
    destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    assert (offc : off_cut (curve_y P + 1) (curve_x P)) by (apply off_cut_intro; left; unfold curve_y; lra).
    destruct (outer_polar _ _ offc) as (sb & cb & _). unfold outer_sq in sb, cb. rewrite (curve_circle P on) in sb, cb.
    rewrite (curve_angle P on) in sb, cb. fold P in sa, ca, hpos. pose proof (tangency_factor P on y) as factor.
    assert (dpos : 0 < sqrt (discriminant P)) by (apply sqrt_lt_R0, on).
    set (b := turn_to (m_of (s_of P)) (s_of P)) in *. apply Rnot_lt_le. intros lt.
    pose proof (scaled_lt _ _ _ hpos (cos_rises b _ ltac:(unfold b, turn_to; pose proof (atan_bound (m_of (s_of P) * c_of (s_of P) / (1 + m_of (s_of P) * s_of P))); lra) lt ltac:(lra))) as higher.
    rewrite factor in improved.
    assert (0 <= (y - curve_y P) * (sqrt (discriminant P) + 3 * (y - curve_y P))) by (apply Rmult_le_pos; lra). lra.
  Qed.

  Theorem lrl_sooner : time_lrl x y < time_rl_left x y.
  Proof.
    pose proof improved_before as lb. rewrite (lrl_by_turning x y lb), (rl_by_turning x y lb).
    destruct (arc_facts x y lb) as (hb & hh & sa & ca & sb & cb & ab & bb). pose proof (first_arc_nonneg x y lb) as le.
    destruct lb as (_ & on & before). fold P in on, before, hb, hh, sa, ca, sb, cb, ab, bb, le |- *.
    set (h := sqrt P) in *. set (a := outer_angle x y) in *. set (b := turn_to (m_of (s_of P)) (s_of P)) in *.
    destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
    pose proof (tangency_factor P on) as factor. assert (dpos : 0 < sqrt (discriminant P)) by (apply sqrt_lt_R0, on).
    set (e := sqrt (discriminant P)) in *. pose proof PI_RGT_0.
    assert (lower : y < curve_y P /\ 3 * (curve_y P - y) < e).
    { rewrite factor in improved. assert (prod : 0 < (curve_y P - y) * (e - 3 * (curve_y P - y))) by lra. split.
      - apply Rnot_le_lt. intros no. assert (0 <= (y - curve_y P) * (e + 3 * (y - curve_y P))) by (apply Rmult_le_pos; lra). lra.
      - apply Rnot_le_lt. intros no. assert (0 <= (curve_y P - y) * (3 * (curve_y P - y) - e)) by (apply Rmult_le_pos; lra). lra. }
    assert (differ : a <> b) by (intros same; rewrite same in ca; lra).
    assert (atcurve : curve_y P = m_of (s_of P) * s_of P) by reflexivity.
    assert (side : curve_x P = m_of (s_of P) * c_of (s_of P)) by reflexivity.
    set (m := m_of (s_of P)) in *. set (s := s_of P) in *.
    assert (ms : m <= s) by lra.
    assert (turned h 0 b < turned h 0 a); [|lra].
    apply turned_falls; [exact hb|lra|]. intros t inside_t.
    destruct (arc_range h t hb) as [below1 nr]. pose proof (arc_circle h t) as onz. rewrite hh in onz.
    set (X := h * sin t) in *. set (Y := h * cos t - 1) in *.
    apply rl_margin_negative; [rewrite onz; exact inside|exact nr|]. rewrite onz, factor.
    assert (E : X * X + Y * Y - Y = P - 3 * Y - 1) by (rewrite <- onz; unfold outer_sq; ring).
    assert (EA : 0 <= m -> P - 3 * curve_y P - 1 <= 0).
    { intros m0. rewrite atcurve. replace (P - 3 * (m * s) - 1) with (- (m * (s - m))) by (rewrite <- circle; ring).
      assert (0 <= m * (s - m)) by (apply Rmult_le_pos; lra). lra. }
    assert (m_sign : 0 <= b -> 0 <= m).
    { intros b0. assert (sinb : 0 <= sin b) by (apply sin_ge_0; lra). apply Rnot_lt_le. intros neg.
      assert (0 <= h * sin b) by (apply Rmult_le_pos; lra). assert (0 < c_of s * - m) by (apply Rmult_lt_0_compat; lra). lra. }
    destruct (Rlt_dec t 0) as [tneg|tpos].
    - assert (Xneg : X < 0).
      { unfold X. pose proof (scaled_lt h (sin t) 0 ltac:(lra) (sin_lt_0_var t ltac:(lra) tneg)). lra. }
      assert (rising : y <= Y).
      { pose proof (scaled_le h _ _ ltac:(lra) (cos_rises_le a t ltac:(lra) ltac:(lra) ltac:(lra))). unfold Y. lra. }
      destruct (Rlt_dec Y (curve_y P)) as [before_y|after_y].
      + left. split; [exact Xneg|]. apply Rmult_lt_0_compat; lra.
      + right. right. split; [exact Xneg|split; [exact below1|]]. rewrite E.
        assert (m0 : 0 <= m); [|specialize (EA m0); lra].
        apply m_sign. apply Rnot_lt_le. intros bneg.
        pose proof (scaled_lt h _ _ ltac:(lra) (cos_rises t b ltac:(lra) ltac:(lra) ltac:(lra))). unfold Y in after_y. lra.
    - right. left. assert (m0 : 0 <= m) by (apply m_sign; lra). specialize (EA m0).
      assert (higher : curve_y P < Y).
      { assert (cb' : cos b < cos t) by (apply cos_decreasing_1; lra). pose proof (scaled_lt h _ _ ltac:(lra) cb'). unfold Y. lra. }
      rewrite E. split; [lra|].
      assert (0 < (Y - curve_y P) * (e + 3 * (Y - curve_y P))) by (apply Rmult_lt_0_compat; lra). lra.
  Qed.
End Improved.

(** Before the switching curve LRL cannot be improved to first order. *)
Lemma lrl_margin_below x y : y <= 0 -> left_below x y -> 0 <= lrl_margin x y.
Proof.
  intros down lb. destruct (arc_facts x y lb) as (hb & hh & sa & ca & sb & cb & ab & bb).
  destruct lb as (left & on & before). unfold lrl_margin. set (P := outer_sq x y) in *.
  set (h := sqrt P) in *. set (a := outer_angle x y) in *. set (b := turn_to (m_of (s_of P)) (s_of P)) in *.
  destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
  assert (onz : x * x + (y + 1) * (y + 1) = P) by reflexivity. pose proof (curve_circle P on) as onc.
  unfold curve_x, curve_y in *. set (s := s_of P) in *. set (c := c_of s) in *. set (m := m_of s) in *. set (w := w_of s) in *.
  replace (x * x + y * y + y) with (P - (y + 1)) by lra.
  assert (ms : 0 <= m + s) by nra.
  destruct (Rle_dec 0 (P - (y + 1))) as [easy|hard].
  - assert (0 <= c * (P - (y + 1))) by (apply Rmult_le_pos; lra).
    assert (0 <= (m + s) * - x) by (apply Rmult_le_pos; lra). lra.
  - destruct (Rle_dec 0 m) as [mnonneg|mneg].
    { exfalso. assert (0 <= m * m) by apply Rle_0_sqr. assert (0 <= m * s) by (apply Rmult_le_pos; lra). lra. }
    pose proof PI_RGT_0. assert (low : P < y + 1) by lra. assert (P0 : 0 < P) by (destruct on; lra).
    assert (bneg : b < 0).
    { apply Rnot_le_lt. intros nonneg. assert (sinb : 0 <= sin b) by (apply sin_ge_0; lra).
      assert (0 <= h * sin b) by (apply Rmult_le_pos; lra). assert (0 < c * - m) by (apply Rmult_lt_0_compat; lra). lra. }
    assert (cospos : 0 < cos a) by (apply Rmult_lt_reg_l with h; lra).
    assert (aq : - (PI / 2) < a).
    { apply Rnot_le_lt. intros le. assert (cos (- a) <= 0) by (apply cos_le_0; lra). rewrite cos_neg in H0. lra. }
    pose proof (scaled_le h _ _ ltac:(lra) (cos_rises_le a b ltac:(lra) before ltac:(lra))) as lower.
    assert (sin a <= sin b) by (destruct before as [lt|eq]; [left; apply sin_increasing_1; lra|rewrite eq; apply Rle_refl]).
    pose proof (scaled_le h _ _ ltac:(lra) H0) as further.
    assert (at_curve : c * (P - (m * s + 1)) = (m + s) * (m * c)) by (rewrite <- circle; ring).
    assert (0 <= c * (m * s - y)) by (apply Rmult_le_pos; lra).
    assert (0 <= (m + s) * (m * c - x)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** The switching curve below the axis keeps its distance from [x = 0]. *)
Lemma curve_left P : reachable P -> P < 1 -> curve_x P <= - ((1 - P) / 4).
Proof.
  intros on lt. destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
  unfold curve_x. set (s := s_of P) in *. set (c := c_of s) in *. set (m := m_of s) in *. set (w := w_of s) in *.
  assert (prod : m * (m + 2 * s) = P - 1) by lra. assert (sum : 0 < m + 2 * s) by nra.
  assert (mneg : m < 0) by nra. assert (s2 : s * s < 3 / 8) by nra. assert (c1 : 1 / 2 <= c) by nra.
  assert (sum2 : m + 2 * s <= 2) by nra.
  assert ((1 - P) / 2 <= - m) by nra. nra.
Qed.

(** Algebra for the next lemma. *)
Lemma product_low A B X D T P : A * B = (P - 4) * T -> T <= 3 * D -> 0 < T -> 0 < P -> X < 0 -> 3 * - X <= B ->
  - (4 * D) <= A * - X.
Proof.
  intros split T3 T0 P0 X0 B3. destruct (Rle_dec 0 A) as [ok|neg].
  - assert (0 <= A * - X) by (apply Rmult_le_pos; lra). lra.
  - assert (0 <= - A * (B - 3 * - X)) by (apply Rmult_le_pos; lra).
    assert (0 <= P * T) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma quotient_low N d D : 1 <= d -> 0 <= D -> - D <= N -> - D <= N / d.
Proof.
  intros d1 D0 low. apply Rmult_le_reg_r with d; [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  assert (0 <= D * (d - 1)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma root_high s w : 0 < s -> 0 < w -> w * w = s * s + 3 -> 7 * (s * w) < 11 * (s * s) + 6.
Proof.
  intros s0 w0 ww. apply Rnot_le_lt. intros le. assert (z0 : 0 < s * s) by (apply Rmult_lt_0_compat; lra).
  assert ((11 * (s * s) + 6) * (11 * (s * s) + 6) <= 7 * (s * w) * (7 * (s * w))) by (apply Rmult_le_compat; lra).
  replace (7 * (s * w) * (7 * (s * w))) with (49 * (s * s) * (w * w)) in H by ring. rewrite ww in H.
  set (z := s * s) in *. clearbody z. nra.
Qed.

Lemma tangency_high e f : 8 * f * (e - 3 * f) <= 3 * (e * e).
Proof.
  assert (0 <= (3 * e - 4 * f) * (3 * e - 4 * f)) by apply Rle_0_sqr. assert (0 <= f * f) by apply Rle_0_sqr. lra.
Qed.

(** Below the axis and next to where LRL begins to exist it is hardly sooner than RL. *)
Lemma lrl_hardly_sooner x y k : y <= 0 -> left_below x y -> outer_sq x y < 1 ->
  0 < k -> k <= curve_x (outer_sq x y) * curve_x (outer_sq x y) ->
  time_rl_left x y - 8 * discriminant (outer_sq x y) / k * sqrt (discriminant (outer_sq x y)) <= time_lrl x y.
Proof.
  intros down lb small kpos kle. rewrite (lrl_by_turning x y lb), (rl_by_turning x y lb).
  destruct (arc_facts x y lb) as (hb & hh & sa & ca & sb & cb & ab & bb). pose proof (first_arc_nonneg x y lb) as le.
  destruct lb as (left & on & before). set (P := outer_sq x y) in *.
  pose proof (curve_left P on small) as cleft.
  set (h := sqrt P) in *. set (a := outer_angle x y) in *. set (b := turn_to (m_of (s_of P)) (s_of P)) in *.
  destruct (on_facts P on) as (spos & below & fifth & cpos & cc & ww & mw & wpos & mP & circle & root).
  pose proof (tangency_factor P on) as factor. assert (dpos : 0 < discriminant P) by apply on.
  pose proof (sqrt_lt_R0 _ dpos) as epos. assert (ee := sqrt_sqrt (discriminant P) ltac:(lra)).
  set (D := discriminant P) in *. set (e := sqrt D) in *. pose proof PI_RGT_0.
  assert (bneg : b < 0).
  { apply Rnot_le_lt. intros nonneg. assert (sinb : 0 <= sin b) by (apply sin_ge_0; lra).
    assert (0 <= h * sin b) by (apply Rmult_le_pos; lra). lra. }
  assert (h1 : h < 1).
  { apply Rnot_le_lt. intros no. assert (1 * 1 <= h * h) by (apply Rmult_le_compat; lra). lra. }
  set (K := 8 * D / k). assert (K0 : 0 <= K) by (unfold K; apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat, kpos]).
  (* what holds on the whole arc *)
  assert (arc : forall t, a <= t < b -> h * sin t < 0 /\ h * cos t - 1 < curve_y P).
  { intros t inside. pose proof (scaled_lt h (sin t) 0 ltac:(lra) (sin_lt_0_var t ltac:(lra) ltac:(lra))).
    pose proof (scaled_lt h _ _ ltac:(lra) (cos_rises t b ltac:(lra) ltac:(lra) ltac:(lra))). split; lra. }
  assert (rate : forall t k', a <= t < b -> (3 * (curve_y P - (h * cos t - 1)) >= e /\ 0 <= k') \/ K <= k' -> 0 <= turned_rate h k' t).
  { intros t k' inside side. destruct (arc t inside) as [Xneg lower]. destruct (arc_range h t hb) as [below1 nr].
    pose proof (arc_circle h t) as onz. rewrite hh in onz.
    assert (Y0 : h * cos t - 1 <= 0) by (pose proof (scaled_le h (cos t) 1 ltac:(lra) (proj2 (COS_bound t))); lra).
    unfold turned_rate. set (X := h * sin t) in *. set (Y := h * cos t - 1) in *.
    destruct (range_below X Y below1) as [qpos rpos].
    assert (vpos : 0 < sqrt (16 - range_sq X Y)) by (apply sqrt_lt_R0; lra).
    assert (den : 0 < / (range_sq X Y * sqrt (16 - range_sq X Y))) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
    assert (kX : forall j, 0 <= j -> 0 <= - (j * X)) by (intros j j0; assert (0 <= j * - X) by (apply Rmult_le_pos; lra); lra).
    destruct (Rle_dec (tangency P Y) 0) as [good|bad].
    { assert (0 <= rl_margin X Y) by (apply rl_margin_below; [rewrite onz; lra|exact nr|exact Y0|right; rewrite onz; exact good]).
      assert (0 <= 2 * rl_margin X Y / (range_sq X Y * sqrt (16 - range_sq X Y))) by (apply Rmult_le_pos; lra).
      assert (0 <= - (k' * X)); [apply kX; destruct side; lra|lra]. }
    assert (short : 3 * (curve_y P - Y) < e).
    { apply Rnot_le_lt. intros no. apply bad. rewrite factor.
      assert (0 <= (curve_y P - Y) * (3 * (curve_y P - Y) - e)) by (apply Rmult_le_pos; lra). lra. }
    destruct side as [[no _]|big]; [lra|].
    pose proof (root_high _ _ spos (w_pos _) ww) as rh.
    assert (up : 0 < Y + 1) by (unfold curve_y in short; rewrite mw, root in short; lra).
    assert (onX : X * X + (Y + 1) * (Y + 1) = P) by exact onz. pose proof (curve_circle P on) as onc.
    assert (wide : k <= X * X).
    { assert ((Y + 1) * (Y + 1) <= (curve_y P + 1) * (curve_y P + 1)) by (apply Rmult_le_compat; lra). lra. }
    assert (T3 : tangency P Y <= 3 * D) by (rewrite factor, <- ee; apply tangency_high).
    destruct (root_facts X Y nr) as (r0 & rr & v0 & vv & squares). rewrite onz in squares.
    unfold rl_margin. set (E := X * X + Y * Y - Y) in *. set (r := range X Y) in *.
    set (v := sqrt (16 - range_sq X Y)) in *.
    assert (qY : range_sq X Y = P - 4 * Y) by (unfold range_sq; lra).
    assert (P0 : 0 < P) by (destruct on; lra).
    assert (r1 : 1 <= r).
    { unfold r, range. rewrite <- sqrt_1. apply sqrt_le_1_alt. assert (0 <= - Y * (2 - Y)) by (apply Rmult_le_pos; lra).
      assert (0 <= X * X) by apply Rle_0_sqr. unfold range_sq. lra. }
    assert (q1 : 1 <= range_sq X Y) by (rewrite <- rr; rewrite <- (Rmult_1_r 1); apply Rmult_le_compat; lra).
    assert (v1 : 1 <= v) by (unfold v; rewrite <- sqrt_1 at 1; apply sqrt_le_1_alt; lra).
    assert (E0 : 0 <= E) by (unfold E; pose proof (Rle_0_sqr X); pose proof (Rle_0_sqr Y); unfold Rsqr in *; lra).
    set (q := range_sq X Y) in *.
    assert (big3 : 3 * - X <= E * v - 3 * r * X).
    { assert (0 <= E * v) by (apply Rmult_le_pos; lra). assert (0 <= (r - 1) * - X) by (apply Rmult_le_pos; lra). lra. }
    pose proof (product_low (3 * r * X + E * v) (E * v - 3 * r * X) X D (tangency P Y) P
      ltac:(lra) T3 ltac:(lra) P0 Xneg big3) as low.
    assert (part : - (8 * D) <= 2 * ((3 * r * X + E * v) * - X) / (q * v)).
    { apply quotient_low; [rewrite <- (Rmult_1_r 1); apply Rmult_le_compat; lra|lra|lra]. }
    apply Rmult_le_reg_r with (- X); [lra|]. rewrite Rmult_0_l.
    replace ((2 * (3 * r * X + E * v) / (q * v) - k' * X) * - X)
      with (2 * ((3 * r * X + E * v) * - X) / (q * v) + k' * (X * X)) by (field; lra).
    assert (8 * D <= k' * (X * X)); [|lra].
    apply Rle_trans with (K * k); [right; unfold K; field; lra|]. apply Rmult_le_compat; lra. }
  assert (level : forall k' t, turned h k' t = turned h 0 t + k' * (h * cos t - 1)) by (intros; unfold turned; ring).
  destruct (Rle_dec e (3 * (curve_y P - y))) as [low|high].
  - (* first up to the other root, then on *)
    set (Y1 := curve_y P - e / 3).
    pose proof (curve_circle P on) as onc.
    assert (r1 : -1 <= (Y1 + 1) / h <= 1).
    { pose proof (root_high _ _ spos (w_pos _) ww) as rh.
      assert (0 < Y1 + 1) by (unfold Y1, curve_y; rewrite mw, root; lra). split.
      - apply Rle_trans with 0; [lra|]. left. apply Rdiv_lt_0_compat; lra.
      - apply Rmult_le_reg_r with h; [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
        pose proof (COS_bound b). assert (h * cos b <= h * 1) by (apply Rmult_le_compat_l; lra). unfold Y1. lra. }
    set (d := - acos ((Y1 + 1) / h)).
    assert (cd : h * cos d - 1 = Y1) by (unfold d; rewrite cos_neg, cos_acos by exact r1; field; lra).
    assert (dd : 0 <= - d <= PI) by (unfold d; pose proof (acos_bound ((Y1 + 1) / h)); lra).
    assert (ad : a <= d).
    { apply Rnot_lt_le. intros lt.
      pose proof (scaled_lt h _ _ ltac:(lra) (cos_rises d a ltac:(lra) ltac:(lra) ltac:(lra))). unfold Y1 in cd. lra. }
    assert (dlb : d <= b).
    { apply Rnot_lt_le. intros lt.
      pose proof (scaled_lt h _ _ ltac:(lra) (cos_rises b d ltac:(lra) ltac:(lra) ltac:(lra))). unfold Y1 in cd. lra. }
    assert (first : turned h 0 a <= turned h 0 d).
    { apply turned_rises; [exact hb|exact ad|]. intros t inside. apply rate; [lra|]. left. split; [|lra].
      pose proof (scaled_le h _ _ ltac:(lra) (cos_rises_le t d ltac:(lra) ltac:(lra) ltac:(lra))). unfold Y1 in cd. lra. }
    assert (second : turned h K d <= turned h K b).
    { apply turned_rises; [exact hb|exact dlb|]. intros t inside. apply rate; [lra|]. right. lra. }
    rewrite !(level K) in second. rewrite cd, cb in second. unfold Y1 in second. fold K.
    assert (0 <= K * e) by (apply Rmult_le_pos; lra). lra.
  - assert (turned h K a <= turned h K b).
    { apply turned_rises; [exact hb|exact le|]. intros t inside. apply rate; [exact inside|]. right. lra. }
    rewrite !(level K) in H0. rewrite ca, cb in H0. fold K.
    assert (K * (curve_y P - y) <= K * e) by (apply Rmult_le_compat_l; lra). lra.
Qed.
