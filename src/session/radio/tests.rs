//! Messages over a bad link.

use mavlink::dialects::ardupilotmega::{GLOBAL_POSITION_INT_DATA, PARAM_VALUE_DATA};

use super::*;
use crate::session::settings::Settings;
use crate::session::{Session, Want};
use crate::wire::{AUTOPILOT_COMPONENT, Decoder, Encoder, ground_station_heartbeat};

const LOST_HALF: RadioFault = RadioFault {
    loss: 0.5,
    delay: Duration::ZERO,
    seed: 3,
};
const CUT: RadioFault = RadioFault {
    loss: 1.0,
    delay: Duration::ZERO,
    seed: 3,
};

fn frame(message: &Outgoing) -> Frame {
    let mut encoder = Encoder::new(1, AUTOPILOT_COMPONENT);
    let mut bytes = Vec::new();
    encoder.encode(message, &mut bytes);
    let mut decoder = Decoder::new();
    decoder.push(&bytes);
    decoder.next_frame().expect("a whole frame")
}

fn at_north(north_m: f64) -> Frame {
    let lat = ((50.0 + north_m / 111_319.49) * 1e7) as i32;
    let message = MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
        lat,
        lon: 300_000_000,
        relative_alt: 20_000,
        ..GLOBAL_POSITION_INT_DATA::default()
    });
    frame(&message.into())
}

fn value(name: &str, value: f32) -> Frame {
    let message = MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
        param_value: value,
        param_id: name.into(),
        ..PARAM_VALUE_DATA::default()
    });
    frame(&message.into())
}

#[test]
fn as_many_frames_are_lost_as_the_fault_says() {
    let heartbeat = frame(&ground_station_heartbeat());
    for (loss, least, most) in [
        (0.0, 10_000, 10_000),
        (0.1, 8_880, 9_120),
        (0.5, 4_800, 5_200),
    ] {
        let mut channel = Channel::new();
        channel.set(RadioFault { loss, ..LOST_HALF }, 1);
        let heard = (0..10_000).filter(|_| channel.hear(&heartbeat, Duration::ZERO));
        let heard = heard.count();
        assert!((least..=most).contains(&heard), "{loss}: {heard}");
    }
}

#[test]
fn what_is_late_comes_in_its_order() {
    let mut channel = Channel::new();
    let delay = Duration::from_millis(100);
    let late = RadioFault {
        loss: 0.0,
        delay,
        seed: 1,
    };
    channel.set(late, 1);
    let at = Duration::from_millis;
    assert!(channel.hear(&at_north(1.0), at(0)) && channel.hear(&at_north(2.0), at(50)));
    assert_eq!(channel.arrived(at(99)), None);
    assert_eq!(channel.arrived(at(100)), Some(at_north(1.0)));
    assert_eq!(channel.arrived(at(149)), None);
    assert_eq!(channel.arrived(at(150)), Some(at_north(2.0)));
    assert!(
        channel
            .say(vec![ground_station_heartbeat()], at(200))
            .is_empty()
    );
    assert_eq!(channel.say(Vec::new(), at(300)).len(), 1);
}

#[test]
fn in_a_blackout_the_operator_sees_nothing_but_the_mission_knows_where_it_is() {
    let mut session = Session::new(1, AUTOPILOT_COMPONENT, Duration::ZERO);
    session.receive(&at_north(10.0), Duration::from_secs(1));
    session.carry_out(Want::Radio(CUT));
    assert!(session.is_cut());
    session.receive(&at_north(80.0), Duration::from_secs(2));
    let vehicle = session.vehicle();
    let seen = vehicle.global.expect("it was heard before").at_point;
    let unheard = vehicle.unheard.expect("it says where it is");
    assert!((seen.lat_deg - 50.0) * 111_319.49 < 11.0);
    assert!((unheard.at.lat_deg - 50.0) * 111_319.49 > 79.0);
    session.poll(Duration::from_secs(4));
    assert!(session.vehicle().link.lost);
    session.carry_out(Want::Radio(RadioFault::default()));
    session.receive(&at_north(90.0), Duration::from_secs(5));
    assert_eq!(session.vehicle().unheard, None);
    assert!(!session.vehicle().link.lost);
}

#[test]
fn parameters_are_said_until_they_hold_by_the_name_that_the_vehicle_has() {
    let vehicle = crate::vehicle::Vehicle::new(1, AUTOPILOT_COMPONENT);
    let mut settings = Settings::default();
    settings.want("SIM_GPS_DISABLE", 1.0);
    let mut names = Vec::new();
    let mut say = |settings: &mut Settings, second: u64| {
        for message in settings.poll(&vehicle, Duration::from_secs(second)) {
            if let Outgoing::Message(MavMessage::PARAM_SET(data)) = message {
                let name = data.param_id.to_str().expect("a name").to_owned();
                names.push((name, data.param_value));
            }
        }
        std::mem::take(&mut names)
    };
    // No message from the vehicle has arrived yet.
    assert!(say(&mut settings, 1).is_empty());
    settings.receive(&frame(&ground_station_heartbeat()));
    assert_eq!(say(&mut settings, 2), [("SIM_GPS_DISABLE".to_owned(), 1.0)]);
    assert_eq!(say(&mut settings, 3), [("SIM_GPS1_ENABLE".to_owned(), 0.0)]);
    settings.receive(&value("SIM_GPS1_ENABLE", 0.0));
    assert!(settings.are_settled() && say(&mut settings, 60).is_empty());
    // Another program switches it on again, or the vehicle reboots.
    settings.receive(&value("SIM_GPS1_ENABLE", 1.0));
    assert_eq!(
        say(&mut settings, 70),
        [("SIM_GPS1_ENABLE".to_owned(), 0.0)]
    );
    settings.receive(&value("SIM_GPS1_ENABLE", 0.0));
    settings.forget();
    assert_eq!(say(&mut settings, 80).len(), 1);
}
