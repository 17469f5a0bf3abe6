//! A vehicle as missions see it, stored as the integers in its messages.

use std::time::Duration;

use serde::{Deserialize, Deserializer, Serialize};

use crate::geo::LatLon;
use crate::mission::saying::TextListener;
use crate::text;
use crate::text::Text;
use crate::vehicle::{
    Battery, Ekf, EkfFlags, GlobalPosition, Health, Heartbeat, LandedState, Mode, Severity,
    StatusText, SystemStatus, TEXTS_KEPT, Unheard, Vehicle, VehicleClass, VehicleId,
};
use crate::wire::AUTOPILOT_COMPONENT;

/// The changes in the state of one vehicle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct ObservedVehicle {
    id: VehicleId,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lost: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mode: Option<ModeLine>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    landed: Option<LandedState>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ready: Option<bool>,
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "said"
    )]
    #[expect(
        clippy::option_option,
        reason = "absent differs from reported as unknown"
    )]
    at: Option<Option<PositionLine>>,
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "said"
    )]
    #[expect(
        clippy::option_option,
        reason = "absent differs from reported as unknown"
    )]
    unheard: Option<Option<UnheardLine>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    battery: Option<BatteryLine>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    said: Vec<String>,
}

/// Class, mode number, armed.
type ModeLine = (VehicleClass, u32, bool);
/// Latitude and longitude in 1e-7 degrees, height above sea level and above home in mm, velocity north, east and down
/// in cm/s.
type PositionLine = (i32, i32, i64, i64, i32, i32, i32);
/// Position of a vehicle that is not heard: latitude and longitude in 1e-7 degrees, height above home in mm.
type UnheardLine = (i32, i32, i64);
/// Voltage in mV, charge in mAh, energy in hJ, percent.
type BatteryLine = (Option<i64>, Option<i64>, Option<i64>, Option<u8>);

/// The state of a vehicle as written to the record so far.
#[derive(Debug, Clone, Default)]
pub(super) struct WatchedVehicle {
    /// The latest values written; `None` before the first.
    known: Option<ObservedVehicle>,
    listener: TextListener,
}

impl WatchedVehicle {
    /// The vehicle's changes since the last call; `None` without any.
    pub fn changes(&mut self, id: VehicleId, vehicle: &Vehicle) -> Option<ObservedVehicle> {
        let now = ObservedVehicle::of(id, vehicle);
        let said = self
            .listener
            .listen(vehicle)
            .iter()
            .map(|text| text.text.clone())
            .collect();
        let known = self.known.replace(now.clone());
        let is_first = known.is_none();
        let known = known.unwrap_or_default();
        let changes = ObservedVehicle {
            id,
            lost: now.lost.filter(|_| now.lost != known.lost),
            mode: now.mode.filter(|_| now.mode != known.mode),
            landed: now.landed.filter(|_| now.landed != known.landed),
            ready: now
                .ready
                .filter(|_| now.ready != known.ready.or(Some(false))),
            at: now.at.filter(|_| now.at != known.at),
            unheard: now
                .unheard
                .filter(|_| now.unheard != known.unheard.or(Some(None))),
            battery: now.battery.filter(|_| now.battery != known.battery),
            said,
        };
        let nothing = ObservedVehicle {
            id,
            ..ObservedVehicle::default()
        };
        (is_first || changes != nothing).then_some(changes)
    }
}

impl ObservedVehicle {
    /// All known values of a vehicle, without its texts.
    pub fn of(id: VehicleId, vehicle: &Vehicle) -> Self {
        Self {
            id,
            lost: Some(vehicle.link.lost),
            mode: vehicle.heartbeat.map(|heartbeat| {
                let mode = heartbeat.mode;
                (mode.class, mode.number, heartbeat.armed)
            }),
            landed: Some(vehicle.landed),
            ready: Some(vehicle.ready_to_arm()),
            at: Some(vehicle.global.map(position)),
            unheard: Some(vehicle.unheard.map(unheard)),
            battery: vehicle.battery().map(battery),
            said: Vec::new(),
        }
    }

    pub fn update(&mut self, changes: &Self) {
        let Self {
            id: _,
            lost,
            mode,
            landed,
            ready,
            at,
            unheard,
            battery,
            said: _,
        } = changes;
        self.lost = lost.or(self.lost);
        self.mode = mode.or(self.mode);
        self.landed = landed.or(self.landed);
        self.ready = ready.or(self.ready);
        self.at = at.or(self.at);
        self.unheard = unheard.or(self.unheard);
        self.battery = battery.or(self.battery);
    }

    pub fn said(&self) -> &[String] {
        &self.said
    }

    /// The first value of this state that no state in `known` contains, as text; `None` if each
    /// value is in at least one of them. A lost link is not compared, because the console decides
    /// on its own when a link is lost.
    pub fn unseen<'a>(&self, known: &(impl Iterator<Item = &'a Self> + Clone)) -> Option<Text> {
        let lacks = |is_so: &dyn Fn(&Self) -> bool| !known.clone().any(is_so);
        let unheard = self.unheard.flatten();
        let is_unheard = |it: &Self| {
            let at = it.at.flatten();
            at.map(|(lat, lon, _, up, ..)| (lat, lon, up)) == unheard
        };
        if self.at.is_some() && lacks(&|it| it.at == self.at)
            || unheard.is_some() && lacks(&is_unheard)
        {
            return Some(text!("verify-other-position"));
        }
        if self.mode.is_some() && lacks(&|it| it.mode == self.mode) {
            return Some(text!("verify-other-mode"));
        }
        if self.landed.is_some() && lacks(&|it| it.landed == self.landed)
            || self.ready.is_some() && lacks(&|it| it.ready == self.ready)
        {
            return Some(text!("verify-other-condition"));
        }
        let is_other = self.battery.is_some() && lacks(&|it| it.battery == self.battery);
        is_other.then(|| text!("verify-other-battery"))
    }

    pub fn id(&self) -> VehicleId {
        self.id
    }

    /// An empty vehicle with this id.
    pub fn vehicle(&self) -> Vehicle {
        // The id identifies the vehicle; its address on the wire does not matter here.
        Vehicle {
            id: self.id,
            ..Vehicle::new(
                u8::try_from(self.id).unwrap_or(u8::MAX),
                AUTOPILOT_COMPONENT,
            )
        }
    }

    /// Sets the vehicle to this state.
    pub fn apply(&self, vehicle: &mut Vehicle, now: Duration) {
        if let Some(lost) = self.lost {
            vehicle.link.lost = lost;
        }
        if let Some((class, number, armed)) = self.mode {
            vehicle.heartbeat = Some(Heartbeat {
                mav_type: 2,
                autopilot: 3,
                class,
                mode: Mode { class, number },
                armed,
                status: SystemStatus::Active,
                at: now,
            });
        }
        if let Some(landed) = self.landed {
            vehicle.landed = landed;
        }
        if let Some(ready) = self.ready {
            vehicle.health = ready.then_some(checked(now));
            vehicle.ekf = ready.then_some(located(now));
        }
        if let Some(at) = self.at {
            vehicle.global = at.map(|at| global(at, now));
        }
        if let Some(unheard) = self.unheard {
            vehicle.unheard = unheard.map(|(lat, lon, up)| Unheard {
                at: LatLon::from_e7(lat, lon),
                altitude_m: up as f64 * 1e-3,
                // Ticks carry the time instead.
                boot_ms: 0,
            });
        }
        if let Some((mv, mah, hj, percent)) = self.battery {
            vehicle.batteries = vec![Battery {
                id: 0,
                voltage_v: mv.map(|mv| mv as f32 * 1e-3),
                current_a: None,
                consumed_mah: mah.map(|mah| mah as f32),
                consumed_wh: hj.map(|hj| hj as f32 * (1.0 / 36.0)),
                remaining_percent: percent,
                at: now,
            }];
        }
        let said = self.said.iter().map(|text| StatusText {
            severity: Severity::Info,
            text: text.clone(),
            at: now,
        });
        vehicle.texts.extend(said);
        let more = vehicle.texts.len().saturating_sub(TEXTS_KEPT);
        vehicle.texts.drain(..more);
    }
}

/// Reads a present field as reported, even if its value is unknown.
#[expect(
    clippy::option_option,
    reason = "absent differs from reported as unknown"
)]
fn said<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Option<Option<T>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

/// A health report which shows only that the vehicle can be armed.
fn checked(now: Duration) -> Health {
    Health {
        present: Health::PREARM,
        enabled: Health::PREARM,
        healthy: Health::PREARM,
        load_percent: f32::NAN,
        at: now,
    }
}

fn located(now: Duration) -> Ekf {
    Ekf {
        flags: EkfFlags(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE),
        velocity_variance: 0.0,
        position_horizontal_variance: 0.0,
        position_vertical_variance: 0.0,
        compass_variance: 0.0,
        at: now,
    }
}

fn unheard(unheard: Unheard) -> UnheardLine {
    let e7 = |degrees: f64| (degrees * 1e7).round() as i32;
    let (lat, lon) = (e7(unheard.at.lat_deg), e7(unheard.at.lon_deg));
    (lat, lon, (unheard.altitude_m * 1e3).round() as i64)
}

fn position(global: GlobalPosition) -> PositionLine {
    let e7 = |degrees: f64| (degrees * 1e7).round() as i32;
    let mm = |metres: f64| (metres * 1e3).round() as i64;
    let cm = |metres: f32| (metres * 100.0).round() as i32;
    (
        e7(global.at_point.lat_deg),
        e7(global.at_point.lon_deg),
        mm(global.altitude_amsl_m),
        mm(global.altitude_m),
        cm(global.north_m_s),
        cm(global.east_m_s),
        cm(global.down_m_s),
    )
}

fn global(at: PositionLine, now: Duration) -> GlobalPosition {
    let (lat, lon, amsl, up, north, east, down) = at;
    GlobalPosition {
        at_point: LatLon::from_e7(lat, lon),
        altitude_amsl_m: amsl as f64 * 1e-3,
        altitude_m: up as f64 * 1e-3,
        north_m_s: north as f32 * 0.01,
        east_m_s: east as f32 * 0.01,
        down_m_s: down as f32 * 0.01,
        heading_deg: None,
        at: now,
    }
}

fn battery(battery: &Battery) -> BatteryLine {
    let whole = |value: Option<f32>, scale: f32| value.map(|value| (value * scale).round() as i64);
    (
        whole(battery.voltage_v, 1e3),
        whole(battery.consumed_mah, 1.0),
        whole(battery.consumed_wh, 36.0),
        battery.remaining_percent,
    )
}
