//! The type masks of setpoints: the fields that are left out.

use mavlink::dialects::ardupilotmega::PositionTargetTypemask as Mask;

/// Bits of the type mask; a set bit means "ignore". A group of three counts as a whole.
pub(crate) const POSITION: u16 = Mask::POSITION_TARGET_TYPEMASK_X_IGNORE.bits()
    | Mask::POSITION_TARGET_TYPEMASK_Y_IGNORE.bits()
    | Mask::POSITION_TARGET_TYPEMASK_Z_IGNORE.bits();
pub(crate) const VELOCITY: u16 = Mask::POSITION_TARGET_TYPEMASK_VX_IGNORE.bits()
    | Mask::POSITION_TARGET_TYPEMASK_VY_IGNORE.bits()
    | Mask::POSITION_TARGET_TYPEMASK_VZ_IGNORE.bits();
pub(crate) const ACCELERATION: u16 = Mask::POSITION_TARGET_TYPEMASK_AX_IGNORE.bits()
    | Mask::POSITION_TARGET_TYPEMASK_AY_IGNORE.bits()
    | Mask::POSITION_TARGET_TYPEMASK_AZ_IGNORE.bits();
/// Forces instead of accelerations: not supported.
pub(crate) const FORCE: u16 = Mask::POSITION_TARGET_TYPEMASK_FORCE_SET.bits();
pub(crate) const YAW: u16 = Mask::POSITION_TARGET_TYPEMASK_YAW_IGNORE.bits();
pub(crate) const YAW_RATE: u16 = Mask::POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE.bits();
/// A mask that leaves only the position.
pub(crate) const POSITION_ONLY: u16 = VELOCITY | ACCELERATION | YAW | YAW_RATE;
/// A mask that leaves velocity and acceleration.
pub(crate) const VELOCITY_ONLY: u16 = POSITION | YAW | YAW_RATE;
