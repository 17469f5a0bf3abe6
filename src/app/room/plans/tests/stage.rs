//! The next step with a draft.

use super::*;
use crate::app::room::plans::{NextStep, PlanStage, next_step};
use crate::draft::TrialFlight;
use crate::ledger::{EntryId, RowState, RowUpdate};
use crate::vehicle::LandedState;

impl Desk {
    fn step(&self) -> Option<NextStep> {
        let state = self.app.state();
        let draft = self.room().drafts().current()?;
        next_step(state, &findings(state, draft.document()))
    }

    fn stage(&self) -> Option<PlanStage> {
        self.step().map(|step| step.stage)
    }

    pub(super) fn next(&self) -> String {
        let step = self.step().expect("a step");
        step.text(self.app.state()).to_string()
    }

    /// Marks the newest command as done for a vehicle.
    fn done(&mut self, vehicle: VehicleId) {
        let newest = self.app.state().session().ledger().entries().len() as u32 - 1;
        let _ = self.app.update(Event::from(VehicleEvent::Row(RowUpdate {
            entry: EntryId(newest),
            vehicle,
            state: RowState::Done,
            tries: 1,
            at: Duration::ZERO,
            explanation: None,
        })));
    }
}

fn at(items: Vec<Item>, mode: u8, armed: bool, landed: LandedState) -> impl FnOnce(&mut Vehicle) {
    move |vehicle| {
        flies_plan(vehicle);
        if let Some(heartbeat) = &mut vehicle.heartbeat {
            (heartbeat.mode, heartbeat.armed) = (Mode::copter(mode), armed);
        }
        vehicle.landed = landed;
        vehicle.plans.plan = Stored {
            content: Some(Arc::new(Plan {
                items,
                home_first: false,
            })),
            transfer: Transfer::Done,
        };
    }
}

/// From the upload to the end of the flight, the hint shows the next possible step.
#[test]
fn the_next_step_follows_the_flight() {
    const AUTO: u8 = 3;
    const GUIDED: u8 = 4;
    let mut desk = Desk::new();
    assert_eq!(desk.stage(), None, "no draft");
    desk.press("ta");
    assert_eq!(desk.stage(), Some(PlanStage::Elsewhere));
    assert!(desk.next().contains("`U`"), "{}", desk.next());
    let items = desk.room().items().to_vec();
    let carrying = |armed, mode, landed| at(items.clone(), mode, armed, landed);
    desk.vehicle(1, carrying(false, GUIDED, LandedState::OnGround));
    assert!(
        desk.next().contains("`arm`, `plan start`"),
        "{}",
        desk.next()
    );
    desk.vehicle(1, carrying(true, GUIDED, LandedState::OnGround));
    assert_eq!(desk.stage(), Some(PlanStage::Armed));
    desk.vehicle(1, carrying(true, AUTO, LandedState::InAir));
    assert_eq!(desk.stage(), Some(PlanStage::Flying));
    assert!(!desk.next().contains("arm"), "{}", desk.next());
    desk.vehicle(1, carrying(true, GUIDED, LandedState::InAir));
    assert!(desk.next().contains("`plan resume`"), "{}", desk.next());
    desk.vehicle(1, carrying(true, GUIDED, LandedState::OnGround));
    desk.give("1 plan start");
    desk.done(1);
    desk.vehicle(1, carrying(false, AUTO, LandedState::OnGround));
    assert_eq!(desk.stage(), Some(PlanStage::Flown));
    assert!(desk.next().contains("`plan clear`"), "{}", desk.next());
}

/// After a failed rehearsal, the hint is to look at its figures, or, while these are shown, to change the draft.
#[test]
fn a_failed_rehearsal_is_not_followed_by_an_upload() {
    let mut desk = Desk::new();
    desk.press("ta");
    let tried = |is_sound, flight| {
        Event::Tried(Tried {
            is_sound,
            flight,
            ..Tried::default()
        })
    };
    let _ = desk.app.update(tried(false, Some(TrialFlight::default())));
    assert_eq!(desk.stage(), Some(PlanStage::Elsewhere));
    assert!(desk.next().contains("`d`"), "{}", desk.next());
    assert!(desk.next().contains("`R`"), "{}", desk.next());
    assert!(!desk.next().contains("`U`"), "{}", desk.next());
    desk.press("d");
    assert!(!desk.next().contains("`d`"), "{}", desk.next());
    let _ = desk.app.update(tried(false, None));
    assert!(desk.next().contains("change the drafts"), "{}", desk.next());
    let items = desk.room().items().to_vec();
    desk.vehicle(1, at(items, 4, false, LandedState::OnGround));
    assert_eq!(desk.stage(), Some(PlanStage::OnBoard));
    assert!(!desk.next().contains("`plan start`"), "{}", desk.next());
    let _ = desk.app.update(tried(true, None));
    assert!(desk.next().contains("`plan start`"), "{}", desk.next());
    let _ = desk.app.update(tried(false, None));
    desk.press("a");
    assert!(desk.next().contains("`U`"), "it is another draft now");
}

#[test]
fn a_step_that_concerns_some_of_the_vehicles_names_them() {
    let mut desk = Desk::new();
    desk.press("ta");
    let items = desk.room().items().to_vec();
    desk.give("select all");
    desk.vehicle(2, at(items, 3, true, LandedState::InAir));
    assert!(desk.next().starts_with("2: "), "{}", desk.next());
}

/// A fence item that the vehicle refuses is one fault, not two.
#[test]
fn a_fault_is_counted_once() {
    let mut desk = Desk::new();
    let circle = Item {
        command: command::FENCE_CIRCLE_INCLUSION,
        params: [50.0, 0.0, 0.0, 0.0],
        x: 2_000_000_000,
        y: 305_200_000,
        ..Item::default()
    };
    let document = Document {
        fence: vec![circle],
        ..Document::default()
    };
    let state = desk.app.state();
    let found = findings(state, &document);
    assert_eq!(found.len(), 1, "{found:?}");
    desk.press("E");
}
