//! What desk and seats show on small terminals.

use super::*;

impl Member {
    async fn resize(&mut self, columns: u16, rows: u16) {
        self.console
            .feed(TerminalEvent::Resize { columns, rows })
            .await;
    }
}

#[tokio::test(start_paused = true)]
async fn the_header_of_a_small_terminal_names_who_watches() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    pair.anna.resize(80, 24).await;
    let instructor = pair.anna.place().seat().instructor().expect("one");
    let instructor = instructor.to_owned();
    let header = |seat: &Member| {
        text(&drawn(&seat.console))
            .lines()
            .next()
            .map(str::to_owned)
    };
    let shown = header(&pair.anna).expect("a line");
    assert!(shown.contains(&format!("desk: {instructor}")), "{shown}");
    assert!(shown.contains("First"), "the title is still there: {shown}");
    pair.desk.console.feed(key(KeyCode::Enter)).await;
    pair.run(1).await;
    let shown = header(&pair.anna).expect("a line");
    assert!(shown.contains(&format!("{instructor} watches")), "{shown}");
}

#[tokio::test(start_paused = true)]
async fn the_first_lines_of_small_tiles_are_whole() {
    let mut pair = Box::pin(Pair::flying(FIRST)).await;
    let mut others = Vec::new();
    for _ in 0..2 {
        others.push(Box::pin(seat(pair.folder.path())).await);
    }
    pair.desk.resize(80, 24).await;
    let mut members = vec![&mut pair.desk, &mut pair.anna];
    members.extend(&mut others);
    run(&mut members, 4).await;
    pair.desk.say("class tiles").await;
    let shown = text(&drawn(&pair.desk.console));
    assert_eq!(shown.matches("air 0/1").count(), 3, "{shown}");
}
