//! Two seats and a desk over a real socket.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::KeyCode;
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::*;
use crate::app::event::TerminalEvent;
use crate::carrier::HostPlace;
use crate::class::{Deed, Happening as Noted, OrderState, Outcome, PictureCell, SeatRecord};
use crate::mission::Mission;
use crate::shell::pace::TICK;
use crate::shell::{ConsoleOptions, Opening, key};
use crate::ui;

mod exams;
mod lessons;
mod pilots;
mod records;
mod screens;
mod showing;
mod situations;

const FIRST: &str = include_str!("../../../missions/00-first-flight.toml");
const WITH_INJECTS: &str = include_str!("../../../missions/12-relay-chain.toml");

/// A console with its end of the class.
struct Member {
    console: Console,
    end: ClassEnd,
}

impl Member {
    async fn new(opening: Opening, class: ClassOptions) -> Self {
        let options = ConsoleOptions {
            class: Some(class),
            ..ConsoleOptions::for_test(opening)
        };
        Box::pin(Self::with(options)).await
    }

    async fn with(options: ConsoleOptions) -> Self {
        let end = ClassEnd::open(&options).await;
        let mut console = Console::new(options, true);
        let (columns, rows) = (120, 40);
        console.feed(TerminalEvent::Resize { columns, rows }).await;
        Box::pin(console.begin()).await;
        let end = end.expect("the desk opens");
        Self { console, end }
    }

    /// What the run loop does in one tick.
    async fn turn(&mut self) {
        self.console.tick().await;
        let moment = Duration::from_millis(2);
        while let Ok(arrival) = tokio::time::timeout(moment, self.end.next()).await {
            self.console.attend(&mut self.end, arrival).await;
            self.tell();
        }
        self.tell();
    }

    fn tell(&mut self) {
        let work = std::mem::take(&mut self.console.class_work);
        self.end.carry_out(work);
        let console = &self.console;
        console.tell_class(&mut self.end, &|| Some(drawn(console)));
    }

    async fn say(&mut self, line: &str) {
        self.console
            .feed(TerminalEvent::Line(line.to_owned()))
            .await;
    }

    fn seats(&self) -> &[SeatRecord] {
        let role = self.console.app.state().class_role();
        role.desk().expect("a desk").seats()
    }

    fn place(&self) -> &SeatPlace {
        let role = self.console.app.state().class_role();
        role.seat().expect("a seat")
    }
}

/// The screen of a console.
fn drawn(console: &Console) -> Picture {
    let (columns, rows) = console.app.state().display().size();
    let backend = TestBackend::new(columns, rows);
    let mut terminal = Terminal::new(backend).expect("a terminal");
    let look = &console.sight.look;
    let frame = terminal.draw(|frame| ui::draw(console.app.state(), look, frame));
    ui::picture(frame.expect("it draws").buffer)
}

fn text(picture: &Picture) -> String {
    let row = |row| -> String {
        let cells = (0..picture.columns()).filter_map(|column| picture.cell(column, row));
        cells.map(PictureCell::symbol).collect::<String>() + "\n"
    };
    (0..picture.rows()).map(row).collect()
}

/// The options of a seat of the class in a folder.
fn seat_options(folder: &Path) -> ClassOptions {
    let path = folder.join("class").display().to_string();
    ClassOptions::Seat {
        place: ClassPlace::named(&path, None).expect("a place"),
        asks: false,
    }
}

/// The options of the desk of the class in a folder.
fn desk_options(folder: &Path) -> ClassOptions {
    let path = folder.join("class").display().to_string();
    ClassOptions::Desk {
        place: DeskPlace::Host(HostPlace::named(&path, None)),
        name: "9-A".to_owned(),
        grader: "petro".to_owned(),
    }
}

async fn desk(folder: &Path) -> Member {
    let member = Member::new(Opening::Home, desk_options(folder));
    Box::pin(member).await
}

async fn seat(folder: &Path) -> Member {
    flying(folder, FIRST).await
}

/// A seat that flies a mission.
async fn flying(folder: &Path, source: &str) -> Member {
    let mission = Mission::parse(source).expect("it is good");
    let opening = Opening::Mission(Arc::new(mission));
    let member = Member::new(opening, seat_options(folder));
    Box::pin(member).await
}

async fn run(members: &mut [&mut Member], seconds: u32) {
    for _ in 0..seconds * 10 {
        tokio::time::sleep(TICK).await;
        for member in &mut *members {
            Box::pin(member.turn()).await;
        }
    }
}

/// A desk, and a seat that flies a mission whose brief is left.
struct Pair {
    desk: Member,
    anna: Member,
    folder: tempfile::TempDir,
}

impl Pair {
    async fn flying(source: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let desk = Box::pin(desk(folder.path())).await;
        let anna = Box::pin(flying(folder.path(), source)).await;
        let mut pair = Self { desk, anna, folder };
        pair.run(4).await;
        pair.anna.console.feed(key(KeyCode::Enter)).await;
        pair.run(2).await;
        pair
    }

    async fn run(&mut self, seconds: u32) {
        run(&mut [&mut self.desk, &mut self.anna], seconds).await;
    }

    /// The newest order to the seat, and what was said about it.
    fn newest(&self) -> (OrderState, String) {
        let order = self.desk.seats()[0].orders().next_back();
        let order = order.expect("an order");
        let why = order.why.as_ref().map(ToString::to_string);
        (order.state, why.unwrap_or_default())
    }
}

#[tokio::test(start_paused = true)]
async fn orders_reach_two_seats_and_a_new_desk_gets_the_whole_journal() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    let mut bohdan = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 4).await;
    assert_eq!(desk.seats().len(), 2);
    assert!(anna.place().seat().class().is_some());

    for seat in [&mut anna, &mut bohdan] {
        seat.console.feed(key(KeyCode::Enter)).await;
    }
    anna.say("all guided").await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 2).await;
    let flights = desk.seats().iter().map(|seat| {
        let report = seat.report.as_ref().expect("it reports");
        report.flight.clone().expect("it flies")
    });
    assert!(
        flights
            .into_iter()
            .all(|it| it.clock_s > 0.5 && it.vehicles == 1)
    );

    desk.say("class freeze @all").await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 1).await;
    for seat in [&anna, &bohdan] {
        assert!(seat.console.app.state().session().is_paused());
    }
    desk.say("class resume @all").await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 1).await;
    for seat in desk.seats() {
        let orders = seat.orders().map(|it| (it.order.deed.clone(), it.state));
        let done = OrderState::Ended(Outcome::Done);
        assert!(orders.eq([(Deed::Freeze, done), (Deed::Resume, done)]));
    }
    assert!(!anna.console.app.state().session().is_paused());

    // A seat stands still until the desk has given its order up: it is not carried out later.
    desk.say("class freeze @all").await;
    run(&mut [&mut desk, &mut bohdan], 12).await;
    let last = |desk: &Member, seat: usize| {
        let order = desk.seats()[seat].orders().next_back();
        order.map(|it| it.state)
    };
    assert_eq!(last(&desk, 0), Some(OrderState::Unanswered));
    assert_eq!(last(&desk, 1), Some(OrderState::Ended(Outcome::Done)));
    run(&mut [&mut desk, &mut anna, &mut bohdan], 4).await;
    assert!(!anna.console.app.state().session().is_paused());
    // One that is still wanted is repeated.
    desk.say("class message @all land").await;
    run(&mut [&mut desk, &mut bohdan], 4).await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 4).await;
    assert_eq!(last(&desk, 0), Some(OrderState::Ended(Outcome::Done)));

    // The desk is killed; a flight goes on without it.
    drop(desk);
    anna.say("all arm").await;
    run(&mut [&mut anna, &mut bohdan], 3).await;
    assert_eq!(anna.console.app.state().class_role().watcher(), None);
    let mut desk = Box::pin(self::desk(folder.path())).await;
    run(&mut [&mut desk, &mut anna, &mut bohdan], 6).await;
    for seat in [&anna, &bohdan] {
        let own = seat.place().seat();
        let mut known = desk.seats().iter();
        let copied = known.any(|it| it.journal.entries().eq(own.journal().entries()));
        assert!(copied, "{:?}", own.journal());
    }
    let commands = anna.place().seat().journal().entries();
    let commands = commands.filter(|it| matches!(it.what, Noted::Command { .. }));
    assert_eq!(commands.count(), 2);
}

#[tokio::test(start_paused = true)]
async fn a_trainee_is_told_of_a_false_socket_and_of_a_false_desk() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = folder.path().join("class");
    std::fs::create_dir(&class).expect("made");
    std::fs::write(class.join("desk"), "no socket").expect("written");
    let told = |seat: &Member| {
        let notices = seat.console.app.state().notices().lines();
        let notices = notices.map(|it| it.notice.text.to_string());
        notices.collect::<Vec<_>>().join("\n")
    };
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut anna], 3).await;
    let text = told(&anna);
    assert!(text.contains("is not a socket"), "{text}");

    std::fs::remove_file(class.join("desk")).expect("removed");
    let mut false_desk = Box::pin(desk(folder.path())).await;
    let place = HostPlace::named(&class.display().to_string(), Some("petro-the-real".into()));
    let options = ClassOptions::Seat {
        place: ClassPlace::Host(place),
        asks: false,
    };
    let mut bohdan = Box::pin(Member::new(Opening::Home, options)).await;
    run(&mut [&mut false_desk, &mut bohdan], 3).await;
    let text = told(&bohdan);
    assert!(text.contains("not to petro-the-real"), "{text}");
    assert!(false_desk.seats().is_empty(), "it hears nothing");
}

#[tokio::test(start_paused = true)]
async fn an_inject_takes_effect_in_the_flight_of_one_seat() {
    let mut pair = Box::pin(Pair::flying(WITH_INJECTS)).await;
    pair.run(1).await;
    let seat = pair.desk.seats().first().expect("a seat");
    let user = seat.name.clone();
    let report = seat.report.clone().and_then(|it| it.flight);
    let offered = report.expect("it flies").injects.into_iter();
    assert!(offered.map(|it| it.name).any(|it| it.as_str() == "gust"));

    pair.desk.say(&format!("class inject @{user} gust")).await;
    pair.desk
        .say("class inject @all motor_fail when t > 6")
        .await;
    pair.desk
        .say("class inject @all link_loss when inside('nowhere') > 0")
        .await;
    pair.run(1).await;
    let outcomes = |desk: &Member| -> Vec<OrderState> {
        let orders = desk.seats()[0].orders();
        orders.map(|given| given.state).collect()
    };
    let ended = OrderState::Ended;
    let refused = ended(Outcome::Refused(Refusal::Condition));
    assert_eq!(
        outcomes(&pair.desk),
        [ended(Outcome::Done), ended(Outcome::Armed), refused]
    );
    pair.run(6).await;
    let done = ended(Outcome::Done);
    assert_eq!(outcomes(&pair.desk), [done, done, refused]);
    let progress = pair.anna.console.app.state().session().mission();
    let injected = progress.expect("it flies").injected.iter();
    let injected: Vec<&str> = injected.map(|it| it.name.as_str()).collect();
    assert_eq!(injected, ["gust", "motor_fail"]);
}

#[tokio::test(start_paused = true)]
async fn the_desk_sees_the_screen_of_a_seat_while_it_watches() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(self::desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    assert_eq!(desk.seats()[0].picture(), None);
    desk.console.feed(key(KeyCode::Enter)).await;
    run(&mut [&mut desk, &mut anna], 1).await;
    assert!(anna.place().seat().is_screen_watched());
    let shown = desk.seats()[0].picture().expect("a picture");
    assert_eq!((shown.columns(), shown.rows()), (120, 40));
    assert!(text(shown).contains("this screen"), "{}", text(shown));

    anna.console.feed(key(KeyCode::Char('?'))).await;
    for member in [&mut anna, &mut desk] {
        tokio::time::sleep(TICK).await;
        Box::pin(member.turn()).await;
    }
    let shown = desk.seats()[0].picture();
    assert_eq!(shown, Some(&drawn(&anna.console)));
    let at_desk = text(&drawn(&desk.console));
    assert!(at_desk.contains("screen of"), "{at_desk}");

    desk.console.feed(key(KeyCode::Esc)).await;
    run(&mut [&mut desk, &mut anna], 1).await;
    assert!(!anna.place().seat().is_screen_watched());
}
