//! Consoles that forward to each other: their frames must not go round and round.

use std::collections::BTreeMap;

use super::*;

/// The time after which the network has settled, and that for which it is watched.
const RUN_MS: u64 = 60_000;
/// A little longer than a second, as timers are: own frames may come back in the gap.
const BEAT_EVERY_MS: u64 = 1007;

/// A port of a console.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct End {
    console: usize,
    port: Port,
}

/// Consoles whose ports are connected with each other. Each port has at most one peer.
struct Network {
    /// The address of each console.
    own: Vec<MavAddress>,
    routers: Vec<Router>,
    wires: BTreeMap<End, End>,
    delay_ms: u64,
    /// The frames on their way, by the time of their arrival.
    travelling: BTreeMap<u64, Vec<(End, Vec<u8>)>>,
    carried: usize,
}

impl Network {
    /// Two consoles with ids of their own, each of which forwards to a link of the other one.
    fn of_two(delay_ms: u64) -> Self {
        let (link, forward) = (Port::Vehicle { link: 1, peer: 0 }, STATION);
        let end = |console, port| End { console, port };
        let pairs = [
            (end(0, link), end(1, forward)),
            (end(1, link), end(0, forward)),
        ];
        let wires = pairs.into_iter().flat_map(|(a, b)| [(a, b), (b, a)]);
        let own = [OWN, address(250, 190)];
        Self {
            own: own.into(),
            routers: own.map(Router::new).into(),
            wires: wires.collect(),
            delay_ms,
            travelling: BTreeMap::new(),
            carried: 0,
        }
    }

    fn send(&mut self, from: End, bytes: &[u8], now: u64) {
        if let Some(&to) = self.wires.get(&from) {
            self.carried += 1;
            let arrivals = self.travelling.entry(now + self.delay_ms).or_default();
            arrivals.push((to, bytes.to_vec()));
        }
    }

    /// Each console sends its heartbeat on all its ports, numbered separately.
    fn beat(&mut self, number: u8, now: u64) {
        for console in 0..self.routers.len() {
            let sender = self.own[console];
            for (at, end) in self.ends(console).into_iter().enumerate() {
                let (bytes, _) = numbered(sender, &beat(), number.wrapping_mul(2) + at as u8);
                if matches!(end.port, Port::Station { .. }) {
                    self.routers[console].note_own(&bytes, ms(now));
                }
                self.send(end, &bytes, now);
            }
        }
    }

    fn ends(&self, console: usize) -> Vec<End> {
        let ends = self.wires.keys().copied();
        ends.filter(|end| end.console == console).collect()
    }

    fn arrive(&mut self, at: End, bytes: &[u8], now: u64) {
        let mut decoder = Decoder::new();
        decoder.push(bytes);
        let frame = decoder.next_frame().expect("a frame");
        let facts = FrameFacts::of(&frame, bytes).expect("facts");
        let route = self.routers[at.console].route(at.port, &facts, ms(now));
        let Route::To { vehicles, stations } = route else {
            return;
        };
        for end in self.ends(at.console) {
            let reach = match end.port {
                Port::Vehicle { .. } => &vehicles,
                Port::Station { .. } if end == at => continue,
                Port::Station { .. } => &stations,
            };
            if *reach == Reach::Everyone {
                self.send(end, bytes, now);
            }
        }
    }

    /// The number of frames that the wires carried per second.
    fn run(mut self) -> f64 {
        for now in 0..RUN_MS {
            if now % BEAT_EVERY_MS == 0 {
                self.beat((now / BEAT_EVERY_MS) as u8, now);
            }
            for (end, bytes) in self.travelling.remove(&now).unwrap_or_default() {
                self.arrive(end, &bytes, now);
            }
            assert!(self.carried < 100_000, "a storm after {now} ms");
        }
        self.carried as f64 * 1000.0 / RUN_MS as f64
    }
}

#[test]
fn consoles_that_forward_to_each_other_make_no_storm() {
    for delay_ms in [1, 20, 400, 999, 1300, 1900] {
        let per_second = Network::of_two(delay_ms).run();
        // Each of the two heartbeats crosses each of the two wires at most twice.
        assert!(per_second <= 9.0, "{per_second} with {delay_ms} ms");
    }
}

/// In a ring, a station's command arrives by its forward and by a link to vehicles, and the link may be the faster way.
#[test]
fn a_command_reaches_its_vehicle_once_whichever_way_is_faster() {
    let ring = Port::Vehicle { link: 1, peer: 0 };
    let takeoff = command(3, MavCmd::MAV_CMD_NAV_TAKEOFF, 0.0, 0.0);
    let station = address(254, 1);
    for ways in [[ring, STATION], [STATION, ring]] {
        let mut router = learned();
        let mut reached = 0;
        for (at, from) in ways.into_iter().chain(ways).enumerate() {
            let route = way(&mut router, from, station, &takeoff, 100 + at as u64);
            if let Route::To { vehicles, stations } = route {
                reached += usize::from(vehicles == Reach::These(vec![VEHICLE]));
                assert_eq!(stations, Reach::Nobody);
            }
        }
        assert_eq!(reached, 1, "{ways:?}");
    }
}
