//! Broken rules and their cost. When one is broken, `mission::event` decides.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// Repetitions by the same vehicle within this time are merged.
const MERGED_WITHIN: Duration = Duration::from_secs(5);

/// A rule; telemetry or the ledger can show that it is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SafetyKind {
    /// Outside the geofence, or inside an excluded area of it.
    Geofence,
    /// Above the maximum height that the mission allows.
    TooHigh,
    /// Crashed or fell, so the vehicle is lost.
    Crash,
    /// Motors stopped in the air by command.
    DisarmInFlight,
    /// Armed by force, or with the arming checks switched off.
    ForcedArm,
    /// Landed with less battery than the reserve, or still in the air and below the reserve at the end of the mission.
    LowReserve,
    /// In the air when the mission ended.
    NotLanded,
    /// Landed too far from any pad.
    OffPad,
    /// The autopilot's battery failsafe, low.
    BatteryLow,
    /// The autopilot's battery failsafe, critical.
    BatteryCritical,
    /// The autopilot's EKF or ground-station failsafe.
    OtherFailsafe,
    /// In a no-fly zone.
    NoFly,
    /// Too close to another vehicle in the air.
    Separation,
    /// Collided with another vehicle in the air.
    Collision,
    /// Too close to a crewed aircraft.
    Bubble,
    /// Too low over people, or too close to a person.
    People,
    /// A person was injured: the mission has failed.
    Injury,
    /// An aircraft was hit: the mission has failed.
    AircraftHit,
}

impl SafetyKind {
    /// Whether it is a failsafe, in which the autopilot takes over to land or to return.
    pub fn is_failsafe(self) -> bool {
        matches!(
            self,
            Self::BatteryLow | Self::BatteryCritical | Self::OtherFailsafe
        )
    }

    /// The share of the safety component that a breach costs: at once, per second, and at most.
    fn price(self) -> (f64, f64, f64) {
        match self {
            Self::Geofence | Self::TooHigh => (0.20, 0.01, 0.40),
            Self::Crash => (0.45, 0.0, 0.45),
            Self::DisarmInFlight | Self::Collision => (0.60, 0.0, 0.60),
            Self::ForcedArm => (0.25, 0.0, 0.25),
            Self::LowReserve => (0.10, 0.0, 0.10),
            Self::OffPad => (0.05, 0.0, 0.05),
            Self::BatteryLow | Self::OtherFailsafe => (0.08, 0.0, 0.08),
            // Not landing costs more than a landing off the pad and below the reserve, so that it is never the better
            // choice.
            Self::NotLanded | Self::BatteryCritical | Self::Separation => (0.20, 0.0, 0.20),
            Self::NoFly => (0.35, 0.0, 0.35),
            Self::Bubble => (0.50, 0.0, 0.50),
            Self::People => (0.30, 0.0, 0.30),
            Self::Injury | Self::AircraftHit => (1.0, 0.0, 1.0),
        }
    }

    /// Whether it means that the vehicle is lost.
    pub fn is_loss(self) -> bool {
        matches!(self, Self::Crash | Self::DisarmInFlight)
    }

    /// Whether it harms people. Then the mission has failed, with at most [`crate::scoring::HARM_POINTS`].
    pub fn is_harm(self) -> bool {
        matches!(self, Self::Injury | Self::AircraftHit)
    }

    /// Advice on how to follow the rule.
    pub(super) fn advice(self) -> SafetyAdvice {
        match self {
            Self::Geofence => SafetyAdvice::StayInside,
            Self::TooHigh => SafetyAdvice::StayBelow,
            Self::Crash => SafetyAdvice::LandGently,
            Self::DisarmInFlight => SafetyAdvice::KeepMotorsOn,
            Self::ForcedArm => SafetyAdvice::KeepChecks,
            Self::LowReserve => SafetyAdvice::KeepReserve,
            Self::NotLanded => SafetyAdvice::LandInTime,
            Self::OffPad => SafetyAdvice::LandOnPad,
            Self::BatteryLow | Self::BatteryCritical => SafetyAdvice::ReturnEarlier,
            Self::OtherFailsafe => SafetyAdvice::AvoidFailsafe,
            Self::NoFly => SafetyAdvice::FlyAround,
            Self::Separation | Self::Collision => SafetyAdvice::KeepApart,
            Self::Bubble | Self::AircraftHit => SafetyAdvice::GiveWay,
            Self::People | Self::Injury => SafetyAdvice::AvoidPeople,
        }
    }
}

/// Advice on broken rules; several rules may share one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SafetyAdvice {
    StayInside,
    StayBelow,
    LandGently,
    KeepMotorsOn,
    KeepChecks,
    KeepReserve,
    LandInTime,
    LandOnPad,
    ReturnEarlier,
    AvoidFailsafe,
    FlyAround,
    KeepApart,
    GiveWay,
    AvoidPeople,
}

impl SafetyAdvice {
    /// The advice as text.
    pub fn text(self) -> Text {
        match self {
            Self::StayInside => text!("scoring-advice-geofence"),
            Self::StayBelow => text!("scoring-advice-height"),
            Self::LandGently => text!("scoring-advice-crash"),
            Self::KeepMotorsOn => text!("scoring-advice-motors"),
            Self::KeepChecks => text!("scoring-advice-force"),
            Self::KeepReserve => text!("scoring-advice-reserve"),
            Self::LandInTime => text!("scoring-advice-land"),
            Self::LandOnPad => text!("scoring-advice-pad"),
            Self::ReturnEarlier => text!("scoring-advice-battery"),
            Self::AvoidFailsafe => text!("scoring-advice-failsafe"),
            Self::FlyAround => text!("scoring-advice-no-fly"),
            Self::KeepApart => text!("scoring-advice-separation"),
            Self::GiveWay => text!("scoring-advice-aircraft"),
            Self::AvoidPeople => text!("scoring-advice-people"),
        }
    }
}

/// One breach of a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct SafetyEvent {
    pub kind: SafetyKind,
    pub vehicle: VehicleId,
    /// Mission time of its start.
    pub at: Duration,
    /// Its duration; zero for a momentary event.
    pub lasted: Duration,
    /// Its text for the debrief.
    pub text: Text,
}

impl SafetyEvent {
    /// The share of the safety component that it costs, 0 to 1.
    pub fn lambda(&self) -> f64 {
        let (once, per_s, most) = self.kind.price();
        (once + per_s * self.lasted.as_secs_f64()).min(most)
    }
}

/// `prod(1 - lambda)` over all events.
pub fn safety_value(events: &[SafetyEvent]) -> f64 {
    events.iter().map(|event| 1.0 - event.lambda()).product()
}

/// Collects events and merges repetitions.
#[derive(Debug, Clone, Default)]
pub struct SafetyLog {
    events: Vec<SafetyEvent>,
    /// The index of the newest event per vehicle and kind, and when it was last seen.
    newest: BTreeMap<(VehicleId, SafetyKind), (usize, Duration)>,
}

impl SafetyLog {
    /// Notes a breach at `now`; a repetition within 5 s extends the event. Returns `true` for a new
    /// event.
    pub fn note(
        &mut self,
        kind: SafetyKind,
        vehicle: VehicleId,
        now: Duration,
        text: &Text,
    ) -> bool {
        if let Some((index, seen)) = self.newest.get_mut(&(vehicle, kind))
            && now.saturating_sub(*seen) <= MERGED_WITHIN
        {
            *seen = now;
            if kind.price().1 > 0.0 {
                let event = &mut self.events[*index];
                event.lasted = now.saturating_sub(event.at);
            }
            return false;
        }
        self.newest
            .insert((vehicle, kind), (self.events.len(), now));
        self.events.push(SafetyEvent {
            kind,
            vehicle,
            at: now,
            lasted: Duration::ZERO,
            text: text.clone(),
        });
        true
    }

    /// All events, oldest first.
    pub fn events(&self) -> &[SafetyEvent] {
        &self.events
    }
}
