//! The trust in the estimate, and its report.

use mavlink::dialects::ardupilotmega::EkfStatusFlags;

/// Flags of `EKF_STATUS_REPORT`: all good with GPS, without a trusted position, with a constant position.
pub(crate) const FLAGS_GOOD: EkfStatusFlags = FLAGS_DISTRUSTED
    .union(EkfStatusFlags::EKF_VELOCITY_HORIZ)
    .union(EkfStatusFlags::EKF_POS_HORIZ_REL)
    .union(EkfStatusFlags::EKF_POS_HORIZ_ABS)
    .union(EkfStatusFlags::EKF_PRED_POS_HORIZ_REL)
    .union(EkfStatusFlags::EKF_PRED_POS_HORIZ_ABS);
const FLAGS_DISTRUSTED: EkfStatusFlags = EkfStatusFlags::EKF_ATTITUDE
    .union(EkfStatusFlags::EKF_VELOCITY_VERT)
    .union(EkfStatusFlags::EKF_POS_VERT_ABS);
pub(crate) const FLAGS_GIVEN_UP: EkfStatusFlags = FLAGS_DISTRUSTED
    .union(EkfStatusFlags::EKF_VELOCITY_HORIZ)
    .union(EkfStatusFlags::EKF_CONST_POS_MODE);

/// The trust in the horizontal position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Trust {
    Good,
    Distrusted,
    GivenUp,
}

/// Test ratios (`EKF_STATUS_REPORT` calls them variances); at 1 or more, a measurement is rejected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ratios {
    pub(crate) velocity: f64,
    pub(crate) position: f64,
    pub(crate) height: f64,
    pub(crate) compass: f64,
}

impl Trust {
    /// The flags while all height sensors work and nothing jumps.
    pub(super) fn flags(self) -> EkfStatusFlags {
        match self {
            Self::Good => FLAGS_GOOD,
            Self::Distrusted => FLAGS_DISTRUSTED,
            Self::GivenUp => FLAGS_GIVEN_UP,
        }
    }
}

impl Ratios {
    /// The ratios in flight without faults.
    pub(crate) const GOOD: Self = Self {
        velocity: 0.007,
        position: 0.01,
        height: 0.0,
        compass: super::compass::GOOD,
    };
}
