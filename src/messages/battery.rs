//! Battery packs, from `BATTERY_STATUS` and, for pack 0, from `SYS_STATUS`.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{BATTERY_STATUS_DATA, SYS_STATUS_DATA};

use crate::vehicle::{Battery, MeanCurrent, Vehicle};

/// The id of the pack that powers the motors.
pub(super) const MAIN_PACK: u8 = 0;
/// The silence of `BATTERY_STATUS` after which `SYS_STATUS` applies to pack 0.
const PACK_SILENT: Duration = Duration::from_secs(5);
/// 1 hJ in Wh.
const WH_PER_HECTOJOULE: f32 = 1.0 / 36.0;

/// Applies `BATTERY_STATUS`. Voltages of cells add up to the pack's; -1 and 65535 mean unknown.
pub(super) fn apply(vehicle: &mut Vehicle, data: &BATTERY_STATUS_DATA, now: Duration) {
    let battery = Battery {
        id: data.id,
        voltage_v: pack_voltage_v(data),
        current_a: current_a(data.current_battery),
        consumed_mah: known(data.current_consumed),
        consumed_wh: known(data.energy_consumed).map(|hectojoules| hectojoules * WH_PER_HECTOJOULE),
        remaining_percent: percent(data.battery_remaining),
        at: now,
    };
    if let Some(current_a) = battery.current_a.filter(|_| data.id == MAIN_PACK) {
        vehicle.load = MeanCurrent::after(vehicle.load, current_a, now);
    }
    *pack(vehicle, data.id, now) = battery;
}

/// Applies the battery fields of `SYS_STATUS` to pack 0, unless `BATTERY_STATUS` has reported that
/// pack recently.
pub(super) fn apply_summary(
    vehicle: &mut Vehicle,
    data: &SYS_STATUS_DATA,
    pack_heard_at: Option<Duration>,
    now: Duration,
) {
    if pack_heard_at.is_some_and(|at| now.saturating_sub(at) < PACK_SILENT) {
        return;
    }
    // ArduPilot reports 0 V if no sensor measures the battery.
    let voltage_v = (!matches!(data.voltage_battery, 0 | u16::MAX))
        .then(|| f32::from(data.voltage_battery) * 1e-3);
    let current_a = current_a(data.current_battery);
    let remaining_percent = percent(data.battery_remaining);
    if voltage_v.is_none() && current_a.is_none() && remaining_percent.is_none() {
        return;
    }
    let main = pack(vehicle, MAIN_PACK, now);
    *main = Battery {
        voltage_v,
        current_a,
        remaining_percent,
        at: now,
        ..*main
    };
}

/// The pack with that id, added if it is new.
fn pack(vehicle: &mut Vehicle, id: u8, now: Duration) -> &mut Battery {
    let packs = &mut vehicle.batteries;
    let index = packs
        .binary_search_by_key(&id, |battery| battery.id)
        .unwrap_or_else(|place| {
            packs.insert(
                place,
                Battery {
                    id,
                    voltage_v: None,
                    current_a: None,
                    consumed_mah: None,
                    consumed_wh: None,
                    remaining_percent: None,
                    at: now,
                },
            );
            place
        });
    &mut packs[index]
}

fn pack_voltage_v(data: &BATTERY_STATUS_DATA) -> Option<f32> {
    // In the extension, 0 means unused as well: older senders leave it out.
    let cells = data.voltages.iter().chain(&data.voltages_ext);
    let total_mv: u32 = cells
        .filter(|&&cell| cell != u16::MAX)
        .map(|&cell| u32::from(cell))
        .sum();
    let any = data.voltages.iter().any(|&cell| cell != u16::MAX);
    any.then_some(total_mv as f32 * 1e-3)
}

/// The current in amperes; `None` for -1, which means that it is not measured, and for other
/// negative values, which are not plausible for a battery in use.
fn current_a(centiamperes: i16) -> Option<f32> {
    (centiamperes >= 0).then(|| f32::from(centiamperes) * 0.01)
}

/// The charge or energy used since the start, in the message's unit; `None` for -1, which means
/// that it is unknown, and for implausible values: other negative ones, and the end of the range.
fn known(count: i32) -> Option<f32> {
    (0..i32::MAX).contains(&count).then_some(count as f32)
}

fn percent(remaining: i8) -> Option<u8> {
    u8::try_from(remaining).ok().map(|percent| percent.min(100))
}
