// @ts-check
/**
 * The slot of a scene: a place on the circle that moves with the hold, which the plan is to enter.
 *
 * @import {Scene, Slot} from "../shared/types.js"
 */

/** A scene with another place of its slot, which it then has, and no leg. @param {Scene} scene @param {Partial<Slot>} slot @returns {Scene} */
export const withSlot = (scene, slot) => ({ ...scene, leg: null, slot: { phase_deg: 0, at_s: 0, ...scene.slot, ...slot } });

/** A scene without a slot. @param {Scene} scene @returns {Scene} */
export const withoutSlot = (scene) => ({ ...scene, slot: null });
