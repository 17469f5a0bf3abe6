//! The state of the model after a recording, with the names of the facts.

use sortie::messages::Inbox;
use sortie::vehicle::Vehicle;
use toml::{Table, Value};

use super::{Reading, Seen};

/// Collects the state of the model under the names of the facts.
struct Observed(Table);

impl Observed {
    fn put(&mut self, key: &str, value: impl Into<Value>) {
        self.0.insert(key.to_owned(), value.into());
    }

    fn list<T: Into<Value>>(&mut self, key: &str, values: impl IntoIterator<Item = T>) {
        self.put(
            key,
            values.into_iter().map(Into::into).collect::<Vec<Value>>(),
        );
    }

    fn link(&mut self, reading: &Reading) {
        let counters = reading.counters;
        self.put("bytes", counters.bytes as i64);
        self.put("frames", counters.frames as i64);
        self.put("unknown", counters.unknown_messages as i64);
        self.put("crc_errors", counters.crc_errors as i64);
        self.put("skipped_bytes", counters.skipped_bytes as i64);
        self.put("signed", reading.signed);
    }

    fn history(&mut self, seen: &Seen) {
        self.list("modes", seen.modes.clone());
        self.list("armed_states", seen.armed.clone());
        self.list("gps_fixed_states", seen.gps_fixed.clone());
        self.list("ekf_position_states", seen.ekf_position.clone());
        self.list("fence_breach_states", seen.fence_breach.clone());
        if let Some(fence) = seen.last_fence {
            let parts = [
                i64::from(fence.breached),
                i64::from(fence.breaches),
                i64::from(fence.breach_type),
            ];
            self.list("fence", parts);
        }
    }

    fn state(&mut self, vehicle: &Vehicle) {
        let heartbeat = vehicle.heartbeat.expect("a heartbeat");
        self.put("system", i64::from(vehicle.id));
        self.put("mode", heartbeat.mode.to_string());
        self.put("armed", vehicle.armed());
        let statuses = [
            "",
            "boot",
            "calibrating",
            "standby",
            "active",
            "critical",
            "emergency",
        ];
        let named = heartbeat.status.to_string();
        self.put(
            "status",
            statuses
                .iter()
                .position(|name| *name == named)
                .expect("a known status") as i64,
        );
        self.put("landed", vehicle.landed as i64);
        self.put("fence_enabled", vehicle.fence.is_some());
        if let Some(boot_ms) = vehicle.boot_ms {
            self.put("boot_ms", i64::from(boot_ms));
        }
        if let Some(health) = vehicle.health {
            self.list(
                "health_bits",
                [health.present, health.enabled, health.healthy].map(i64::from),
            );
            self.put("load_permille", rounded(health.load_percent * 10.0));
        }
        if let Some(ekf) = vehicle.ekf {
            self.put("ekf_flags", i64::from(ekf.flags.0));
        }
        if let Some(gps) = vehicle.gps {
            self.put("gps_fix", gps.fix as i64);
            self.put("satellites", gps.satellites.map_or(255, i64::from));
            self.put(
                "hdop_c",
                gps.hdop.map_or(65_535, |hdop| rounded(hdop * 100.0)),
            );
        }
        self.put("plan_current", i64::from(vehicle.plan.current));
        self.put("plan_total", vehicle.plan.total.map_or(-1, i64::from));
        self.put("plan_reached", vehicle.plan.reached.map_or(-1, i64::from));
        let texts = vehicle.texts.iter().map(|text| {
            Value::Array(vec![
                (text.severity as i64).to_string().into(),
                text.text.clone().into(),
            ])
        });
        self.list("texts", texts);
    }

    fn motion(&mut self, vehicle: &Vehicle) {
        if let Some(attitude) = vehicle.attitude {
            self.list(
                "attitude_deg",
                [attitude.roll_deg, attitude.pitch_deg, attitude.yaw_deg],
            );
        }
        if let Some(global) = vehicle.global {
            let (lat_e7, lon_e7) = global.at_point.to_e7();
            self.list("position_e7", [lat_e7, lon_e7]);
            self.put("altitude_mm", rounded(global.altitude_m * 1e3));
            self.put("altitude_amsl_mm", rounded(global.altitude_amsl_m * 1e3));
            self.put(
                "heading_cd",
                global
                    .heading_deg
                    .map_or(65_535, |heading| rounded(heading * 100.0)),
            );
            let velocity_m_s = [global.north_m_s, global.east_m_s, global.down_m_s];
            self.list(
                "velocity_cm_s",
                velocity_m_s.map(|part| rounded(part * 100.0)),
            );
        }
        if let Some(local) = vehicle.local {
            self.list("local_m", local.ned_m);
        }
        if let Some(home) = vehicle.home {
            let (lat_e7, lon_e7) = home.at_point.to_e7();
            self.list(
                "home",
                [
                    i64::from(lat_e7),
                    i64::from(lon_e7),
                    rounded(home.altitude_amsl_m * 1e3),
                ],
            );
        }
        if let Some(hud) = vehicle.hud {
            let throttle_percent = f32::from(hud.throttle_percent);
            let speeds = [hud.airspeed_m_s, hud.ground_speed_m_s, hud.climb_m_s];
            let rest = [hud.altitude_amsl_m, throttle_percent, hud.heading_deg];
            self.list("hud", speeds.into_iter().chain(rest));
        }
        if let Some(wind) = vehicle.wind {
            self.list("wind", [wind.from_deg, wind.speed_m_s]);
        }
    }

    fn hardware(&mut self, vehicle: &Vehicle) {
        if let Some(battery) = vehicle.battery() {
            for (key, value) in [
                ("voltage_mv", battery.voltage_v.map(|volts| volts * 1e3)),
                (
                    "current_ca",
                    battery.current_a.map(|amperes| amperes * 100.0),
                ),
                ("consumed_mah", battery.consumed_mah),
                (
                    "consumed_hj",
                    battery.consumed_wh.map(|watt_hours| watt_hours * 36.0),
                ),
                (
                    "remaining_percent",
                    battery.remaining_percent.map(f32::from),
                ),
            ] {
                self.put(key, value.map_or(-1, rounded));
            }
        }
        if let Some(vibration) = vehicle.vibration {
            self.list("vibration_m_s2", vibration.level_m_s2);
        }
        if let Some(rc) = vehicle.rc {
            self.list("rc_us", rc.channels_us.map(i64::from));
        }
        self.list("servos_us", vehicle.servos_us.map(i64::from));
        if let Some(version) = vehicle.version {
            let (major, minor, patch) = version.firmware;
            self.list("firmware", [major, minor, patch].map(i64::from));
            self.put("capabilities", version.capabilities as i64);
            self.put(
                "firmware_hash",
                String::from_utf8_lossy(&version.hash).into_owned(),
            );
        }
    }

    fn parameters(&mut self, inbox: &Inbox) {
        let parameters = inbox.parameters();
        self.put("parameters", parameters.len() as i64);
        let indexed = parameters
            .iter()
            .filter(|(_, parameter)| parameter.index.is_some());
        self.put("parameters_indexed", indexed.count() as i64);
        self.put("parameter_count", parameters.count().map_or(-1, i64::from));
        for (name, parameter) in parameters.iter() {
            self.put(&format!("parameter_{name}"), parameter.value);
        }
    }
}

fn rounded(value: impl Into<f64>) -> i64 {
    value.into().round() as i64
}

/// This program's whole reading of a recording, with the names of the facts.
pub(super) fn observed(reading: &Reading) -> Table {
    let mut observed = Observed(Table::new());
    observed.link(reading);
    observed.history(&reading.seen);
    observed.state(&reading.vehicle);
    observed.motion(&reading.vehicle);
    observed.hardware(&reading.vehicle);
    observed.parameters(&reading.inbox);
    observed.0
}
