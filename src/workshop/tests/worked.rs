//! Designs whose figures were computed by hand.

use super::*;

pub struct Worked {
    name: &'static str,
    /// The ids of the design's parts.
    parts: &'static str,
    mass_g: f64,
    credits: u32,
    thrust_to_weight: f64,
    hover_power_w: f64,
    hover_min: f64,
    range_speed_m_s: f64,
    range_km: f64,
}

impl Worked {
    pub fn design(&self) -> Design {
        design(self.name, self.parts)
    }
}

/// Designs computed by hand with the same formulas; A, B, D and G were also flown in SITL 4.6 (G with a laser
/// altimeter of 20 g and 300 credits).
pub const WORKED: [Worked; 6] = [
    Worked {
        name: "A",
        parts: "fr_450q m2212_920 p10x4.5p b3s5000 e30opto gps_m8n pm_02 fc_h7 s_pm25 r_sik915",
        mass_g: 1250.0,
        credits: 483,
        thrust_to_weight: 1.97,
        hover_power_w: 167.1,
        hover_min: 16.6,
        range_speed_m_s: 11.5,
        range_km: 9.6,
    },
    Worked {
        name: "B",
        parts: "fr_500q m2215_900 p10x4.5 b4s5000 e20 gps_m8n pm_02 fc_px6c r_sik915",
        mass_g: 1685.0,
        credits: 782,
        thrust_to_weight: 2.66,
        hover_power_w: 211.8,
        hover_min: 17.6,
        range_speed_m_s: 12.5,
        range_km: 11.2,
    },
    Worked {
        name: "D",
        parts: "fr_650q_tube m4006_380 p15x5cf l6s2p_p50b e40 gps_m10 pm_02 fc_px6c s_rgbg r_rfd900",
        mass_g: 1920.0,
        credits: 1595,
        thrust_to_weight: 3.42,
        hover_power_w: 171.7,
        hover_min: 68.9,
        range_speed_m_s: 12.5,
        range_km: 45.4,
    },
    Worked {
        name: "F",
        parts: "fr_680h m3508_380 p13x5.5 b6s8000 e40 gps_m10 pm_02 fc_px6c s_gas4 s_rgbg r_rfd900",
        mass_g: 3140.0,
        credits: 2260,
        thrust_to_weight: 2.64,
        hover_power_w: 329.0,
        hover_min: 27.2,
        range_speed_m_s: 13.5,
        range_km: 19.3,
    },
    Worked {
        name: "G",
        parts: "fr_960h m5008_340 p18x6.1cf b6s22000 e40 gps_f9p pm_hv fc_cube s_gpr r_rfd900",
        mass_g: 7800.0,
        credits: 6215,
        thrust_to_weight: 2.64,
        hover_power_w: 920.6,
        hover_min: 26.7,
        range_speed_m_s: 16.0,
        range_km: 23.7,
    },
    Worked {
        name: "J",
        parts: "fr_750q_tube m5006_300 p18x6.1cf l6s3p_p50b e40 gps_m10 pm_02 fc_px6c s_relay r_mesh24",
        mass_g: 2710.0,
        credits: 2750,
        thrust_to_weight: 3.25,
        hover_power_w: 235.0,
        hover_min: 75.8,
        range_speed_m_s: 13.5,
        range_km: 54.0,
    },
];

#[test]
fn worked_examples_come_out_as_worked_out() {
    for worked in &WORKED {
        let name = worked.name;
        let drone = worked.design();
        let figures = drone.figures(Air::default()).expect("complete");
        let close = |what: &str, found: f64, wanted: f64, share: f64| {
            let error = (found - wanted).abs() / wanted;
            assert!(
                error <= share,
                "{name}: {what} {found:.3} instead of {wanted}"
            );
        };
        close("mass", figures.mass_kg, worked.mass_g * 1e-3, 0.005);
        assert_eq!(figures.credits, worked.credits, "{name}");
        close(
            "thrust",
            figures.thrust_to_weight,
            worked.thrust_to_weight,
            0.006,
        );
        close("power", figures.hover_power_w, worked.hover_power_w, 0.005);
        close("time", figures.hover_time_s / 60.0, worked.hover_min, 0.012);
        close(
            "speed",
            figures.range_speed_m_s,
            worked.range_speed_m_s,
            0.05,
        );
        close("range", figures.range_m / 1000.0, worked.range_km, 0.012);
        assert!(
            drone.is_airworthy(Air::default()),
            "{name}: {:?}",
            drone.findings(Air::default())
        );
    }
}
