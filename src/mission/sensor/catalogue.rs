//! The sensors that missions may name, with the ids of the parts catalogue.

use super::detector::MineSpec;
use super::{Band, Camera, DetectorSpec, Ground, Noise, ProbeSpec, Response, Sensor, Work};
use crate::mission::ground_truth::Quantity;

/// All sensors.
///
/// The photoionisation detector reaches 90 % of a step in 3 s, so five seconds in a cell are enough for it; the
/// optical particle counter needs 18 s, the electrochemical cell 25 s. A ppm of vapour refers to isobutylene at
/// 25 degrees (56.11 g/mol, 24.45 l/mol). The scintillator counts 65 times a second in natural background and needs
/// 5 us for a pulse; the Geiger tube counts 1.5 times a second in 1 uSv/h.
pub(crate) static SENSORS: &[Sensor] = &[
    Sensor {
        id: "s_voc",
        name: "mission-sensor-gas",
        work: Work::Probe(ProbeSpec {
            quantity: Quantity::Vapour,
            unit: "ppm",
            gain: 24.45 / 56.11 * 1e-3,
            tau_s: 1.3,
            response: inlet(0.10, 0.01),
            ceiling: 50.0,
        }),
    },
    Sensor {
        id: "s_pm25",
        name: "mission-sensor-particles",
        work: Work::Probe(ProbeSpec {
            quantity: Quantity::Particles,
            unit: "ug/m3",
            gain: 1.0,
            tau_s: 8.0,
            response: inlet(0.10, 1.0),
            ceiling: 1000.0,
        }),
    },
    Sensor {
        id: "s_gas4",
        name: "mission-sensor-monoxide",
        work: Work::Probe(ProbeSpec {
            quantity: Quantity::Monoxide,
            unit: "ppm",
            gain: 24.45 / 28.01 * 1e-3,
            tau_s: 10.9,
            response: inlet(0.05, 0.05),
            ceiling: 1000.0,
        }),
    },
    Sensor {
        id: "s_tdlas",
        name: "mission-sensor-methane",
        work: Work::Probe(ProbeSpec {
            quantity: Quantity::Methane,
            unit: "ppm*m",
            gain: 24.45 / 16.04 * 1e-3,
            tau_s: 0.1,
            response: Response::Beam(Noise {
                share: 0.05,
                floor: 5.0,
            }),
            ceiling: 50_000.0,
        }),
    },
    Sensor {
        id: "s_geiger",
        name: "mission-sensor-dose-rate",
        work: Work::Probe(ProbeSpec {
            quantity: Quantity::DoseRate,
            unit: "uSv/h",
            gain: 1.0,
            tau_s: 3.0,
            response: Response::Counter {
                per_unit_s: 1.5,
                dead_time_s: 190e-6,
            },
            ceiling: 3000.0,
        }),
    },
    Sensor {
        id: "s_csi",
        name: "mission-sensor-dose-rate",
        work: Work::Probe(ProbeSpec {
            quantity: Quantity::DoseRate,
            unit: "uSv/h",
            gain: 1.0,
            tau_s: 1.0,
            response: Response::Counter {
                per_unit_s: 650.0,
                dead_time_s: 5e-6,
            },
            ceiling: 250.0,
        }),
    },
    camera("s_rgb", "mission-sensor-camera", RGB),
    camera("s_rgbg", "mission-sensor-camera", RGB_GIMBAL),
    camera("s_zoom", "mission-sensor-zoom", ZOOM),
    camera("s_th160", "mission-sensor-thermal", THERMAL_160),
    camera("s_th320", "mission-sensor-thermal", THERMAL_320),
    camera("s_thdual", "mission-sensor-thermal", THERMAL_640),
    ground(
        "s_mag",
        "mission-sensor-magnetometer",
        2.0,
        MineSpec {
            best: [0.85, 0.10, 0.80, 0.60],
            height_m: 1.5,
            height_scale_m: 1.0,
            speed_m_s: 4.0,
            false_alarms_per_m2: 0.003,
        },
    ),
    ground(
        "s_md",
        "mission-sensor-metal-detector",
        0.6,
        MineSpec {
            best: [0.95, 0.75, 0.95, 0.90],
            height_m: 0.25,
            height_scale_m: 0.15,
            speed_m_s: 1.0,
            false_alarms_per_m2: 0.006,
        },
    ),
    ground(
        "s_gpr",
        "mission-sensor-radar",
        0.8,
        MineSpec {
            best: [0.90, 0.85, 0.60, 0.10],
            height_m: 0.8,
            height_scale_m: 0.3,
            speed_m_s: 1.5,
            false_alarms_per_m2: 0.003,
        },
    ),
];

const fn inlet(share: f64, floor: f64) -> Response {
    Response::Inlet(Noise { share, floor })
}

const fn camera(id: &'static str, name: &'static str, camera: Camera) -> Sensor {
    Sensor {
        id,
        name,
        work: Work::Detector(DetectorSpec::Camera(camera)),
    }
}

const fn ground(id: &'static str, name: &'static str, swath_m: f64, mines: MineSpec) -> Sensor {
    Sensor {
        id,
        name,
        work: Work::Detector(DetectorSpec::Ground(Ground { swath_m, mines })),
    }
}

/// The detection of mines in the open by a lens that achieves the required 5 mm per pixel up to this height.
const fn open_mines(height_m: f64) -> MineSpec {
    MineSpec {
        best: [0.0, 0.0, 0.70, 0.20],
        height_m,
        height_scale_m: 5.0,
        speed_m_s: 4.0,
        false_alarms_per_m2: 0.0008,
    }
}
/// The detection of mines by thermal cameras: disturbed soil has a different temperature around dawn and dusk.
const WARM_MINES: MineSpec = MineSpec {
    best: [0.25, 0.25, 0.60, 0.15],
    height_m: 15.0,
    height_scale_m: 10.0,
    speed_m_s: 3.0,
    false_alarms_per_m2: 0.001,
};

/// A fixed camera with 12 megapixels, looking down.
const RGB: Camera = Camera {
    band: Band::Visible,
    view_deg: [69.0, 42.0],
    pixels: 4000.0,
    mines: Some(open_mines(14.5)),
    inspects_to_m: None,
};
/// A 4K camera on a gimbal.
const RGB_GIMBAL: Camera = Camera {
    band: Band::Visible,
    view_deg: [81.0, 52.0],
    pixels: 3840.0,
    mines: Some(open_mines(11.2)),
    inspects_to_m: Some(12.0),
};
/// A camera with tenfold zoom, which identifies objects from six times as far as the plain gimbal camera.
const ZOOM: Camera = Camera {
    band: Band::Visible,
    view_deg: [15.0, 9.0],
    pixels: 3840.0,
    mines: None,
    inspects_to_m: Some(72.0),
};
/// A thermal camera with 160 x 120 pixels, Lepton class.
const THERMAL_160: Camera = Camera {
    band: Band::Thermal,
    view_deg: [57.0, 44.0],
    pixels: 160.0,
    mines: Some(WARM_MINES),
    inspects_to_m: None,
};
/// A thermal camera with 320 x 256 pixels, Boson class.
const THERMAL_320: Camera = Camera {
    band: Band::Thermal,
    view_deg: [34.0, 27.0],
    pixels: 320.0,
    mines: Some(WARM_MINES),
    inspects_to_m: None,
};
/// A thermal camera with 640 pixels across, on a gimbal.
const THERMAL_640: Camera = Camera {
    band: Band::Thermal,
    view_deg: [33.0, 26.0],
    pixels: 640.0,
    mines: None,
    inspects_to_m: Some(12.0),
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_guide_has_the_price_of_every_sensor() {
        let guide = include_str!("../../../docs/missions.md");
        for sensor in SENSORS {
            let part = crate::workshop::part(sensor.id).expect("the workshop has it");
            let price = format!("`{}` {}", sensor.id, part.credits);
            assert!(guide.contains(&price), "{price}");
        }
    }
}
