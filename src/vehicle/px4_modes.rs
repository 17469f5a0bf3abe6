//! The modes of PX4. Source: `px4_custom_mode.h` of PX4: the main mode and the sub-mode are the upper two bytes of
//! `custom_mode`.

/// The number of a mode (`custom_mode`) from its main mode and its sub-mode, 0 for none.
const fn number(main: u8, sub: u8) -> u32 {
    u32::from_le_bytes([0, 0, main, sub])
}

const POSCTL: u8 = 3;
const AUTO: u8 = 4;

/// Modes by number; those with a sub-mode have two-part names.
pub(super) const PX4: &[(u32, &str)] = &[
    (number(1, 0), "MANUAL"),
    (number(2, 0), "ALTCTL"),
    (number(POSCTL, 0), "POSCTL"),
    (number(POSCTL, 1), "POSCTL.ORBIT"),
    (number(POSCTL, 2), "POSCTL.SLOW"),
    (number(AUTO, 1), "AUTO.READY"),
    (number(AUTO, 2), "AUTO.TAKEOFF"),
    (number(AUTO, 3), "AUTO.LOITER"),
    (number(AUTO, 4), "AUTO.MISSION"),
    (number(AUTO, 5), "AUTO.RTL"),
    (number(AUTO, 6), "AUTO.LAND"),
    (number(AUTO, 8), "AUTO.FOLLOW"),
    (number(AUTO, 9), "AUTO.PRECLAND"),
    (number(AUTO, 10), "AUTO.VTOL_TAKEOFF"),
    (number(AUTO, 11), "AUTO.EXTERNAL1"),
    (number(AUTO, 12), "AUTO.EXTERNAL2"),
    (number(AUTO, 13), "AUTO.EXTERNAL3"),
    (number(AUTO, 14), "AUTO.EXTERNAL4"),
    (number(AUTO, 15), "AUTO.EXTERNAL5"),
    (number(AUTO, 16), "AUTO.EXTERNAL6"),
    (number(AUTO, 17), "AUTO.EXTERNAL7"),
    (number(AUTO, 18), "AUTO.EXTERNAL8"),
    (number(5, 0), "ACRO"),
    (number(6, 0), "OFFBOARD"),
    (number(7, 0), "STABILIZED"),
    (number(8, 0), "RATTITUDE"),
    (number(10, 0), "TERMINATION"),
];
