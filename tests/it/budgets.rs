//! The embedded missions' budgets: every mission can be flown with vehicles that are within its
//! budget.

use sortie::mission::{Mission, Need};
use sortie::store;
use sortie::workshop::{Design, part};

fn stock() -> Vec<Design> {
    let designs = store::designs();
    let designs = designs.iter().map(|source| Design::from_toml(&source.text));
    designs
        .map(|design| design.expect("a good design"))
        .collect()
}

/// A design without its payload, and with the required parts instead.
fn equipped(design: &Design, need: &Need) -> Option<Design> {
    let carried: Vec<_> = design
        .pieces()
        .filter(|(part, _)| part.slot().key() == "payload")
        .collect();
    let bare = carried
        .iter()
        .fold(design.clone(), |design, (part, pieces)| {
            (0..*pieces).fold(design, |design, _| design.without(part))
        });
    let sensors = need.sensors.iter().map(|id| (*id, 1));
    sensors
        .chain(need.loads.iter().copied())
        .try_fold(bare, |design, (id, pieces)| {
            let part = part(id)?;
            Some((0..pieces).fold(design, |design, _| design.with(part)))
        })
}

/// The cheapest stock design that has the required parts.
fn cheapest(need: &Need) -> Option<Design> {
    let equipped = stock().into_iter().filter_map(|it| equipped(&it, need));
    equipped
        .filter(|design| design.is_airworthy(need.air))
        .filter(|design| need.fit(design).iter().all(|line| !line.is_block))
        .min_by_key(Design::credits)
}

#[test]
fn every_mission_can_be_flown_with_built_vehicles_within_its_budget() {
    for source in store::missions() {
        let mission = Mission::parse(&source.text).expect("no faults");
        let (id, budget) = (mission.id.clone(), mission.seats.outlay.budget);
        let seats = mission.needs().iter().map(|need| need.seats.len()).sum();
        let mut fleet = vec![Design::new("none"); seats];
        for need in mission.needs() {
            let Some(design) = cheapest(&need) else {
                panic!("{id}: nothing flies on seats {:?}", need.seats);
            };
            for seat in &need.seats {
                fleet[usize::from(*seat) - 1] = design.clone();
            }
        }
        let cost: u32 = fleet.iter().map(Design::credits).sum();
        let first = fleet.first().map(|design| design.name.clone());
        println!("{id}: {cost} of {budget:?} cr, {first:?}");
        if let Err(reasons) = mission.with_fleet(fleet) {
            panic!("{id}: {reasons:?}");
        }
    }
}
