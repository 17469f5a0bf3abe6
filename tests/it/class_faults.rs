//! A class on one host whose programs are killed. For several machines, see `machines`.

use crate::terminal::Terminal;

#[test]
fn a_killed_desk_and_killed_seats_lose_nothing_of_the_journals_of_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = folder.path().join("9-A").display().to_string();
    let open_desk = || Terminal::start(&["class", "open", &class], 140, 40);
    let fly = || {
        let mut seat = Terminal::start(&["fly", "00", "--class", &class], 120, 40);
        seat.see("desk: ").press("F").see("FLY");
        seat
    };
    let mut desk = open_desk();
    desk.see("No trainee has joined yet");
    let mut first = fly();
    first.command("1 guided").see("1 guided  effect seen");
    desk.see("1 guided");

    desk.kill();
    first.see("the desk is gone").command("1 arm");
    first.see("1 arm  effect seen");
    let mut desk = open_desk();
    // From before the kill, and from while there was no desk.
    desk.see("1 guided").see("1 arm");

    let mut second = fly();
    desk.see("1 of 1 seat connected, 2 consoles");
    second.kill();
    desk.see(" ago");
    desk.command("class message @all look at the battery");
    first.see("look at the battery");
    // Another console of the trainee takes the row.
    let mut again = fly();
    desk.see("2 consoles");
    desk.command("class message @all land now");
    again.see("land now");
    first.see("land now");
}
