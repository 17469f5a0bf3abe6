//! Motors that fail, batteries that empty, frames of other sizes.

use mavlink::dialects::ardupilotmega::MavCmd;

use super::*;

#[test]
fn explore() {
    for (fail, mul) in [(1.0, 0.0), (1.0, 0.7), (1.0, 0.5)] {
        let mut ground = Ground::hovering(25.0);
        let start = ground.truth();
        ground.set("SIM_ENGINE_FAIL", fail);
        ground.set("SIM_ENGINE_MUL", mul);
        println!("== {fail} {mul}");
        let mut told = 0;
        let mut most: f64 = 0.0;
        for step in 0..800 {
            ground.step();
            let t = ground.truth();
            if ground.texts().len() != told {
                told = ground.texts().len();
                println!("{:.2} {:?}", f64::from(step) * 0.01, ground.texts().last());
            }
            let off = [0, 1, 2].map(|i| t.position_ned_m[i] - start.position_ned_m[i]);
            most = most.max(off[0].hypot(off[1]).hypot(off[2]));
            if step % 20 == 0 {
                println!(
                    "{:.1} h {:.2} v {:.2?} r {:.0} p {:.0} y {:.0} thr {:.2} A {:.1} off {most:.2}",
                    f64::from(step) * 0.01,
                    -t.position_ned_m[2],
                    t.velocity_ned_m_s,
                    t.roll_deg,
                    t.pitch_deg,
                    t.heading_deg,
                    t.throttle,
                    t.battery_current_a
                );
            }
        }
        println!("{:?}", ground.texts());
    }
}

#[test]
fn explore_wind() {
    for turb in [1.0, 3.0] {
        let mut ground = Ground::hovering(25.0);
        ground.set("SIM_WIND_TURB", turb);
        ground.run(3.0);
        let (mut n, mut sq, mut most) = (0.0, [0.0; 3], [0.0f64; 3]);
        let mut lean: f64 = 0.0;
        for _ in 0..6000 {
            ground.step();
            let t = ground.truth();
            lean = lean.max(t.roll_deg.hypot(t.pitch_deg));
            n += 1.0;
            for i in 0..3 {
                let off = t.position_ned_m[i] + if i == 2 { 25.0 } else { 0.0 };
                sq[i] += off * off;
                most[i] = most[i].max(off.abs());
            }
        }
        println!(
            "== turb {turb} std {:.3?} most {most:.3?} lean {lean:.1}",
            sq.map(|s: f64| (s / n).sqrt())
        );
    }
    let mut ground = Ground::hovering(25.0);
    ground.set("SIM_WIND_SPD", 10.0);
    ground.set("SIM_WIND_DIR", 90.0);
    let mut most: (f64, usize) = (0.0, 0);
    for step in 0..2000 {
        ground.step();
        let y = ground.truth().position_ned_m[1];
        if y.abs() > most.0.abs() {
            most = (y, step);
        }
        if step % 100 == 0 {
            println!("== {step} {y:.2}");
        }
    }
    println!("== step {most:?}");
}
