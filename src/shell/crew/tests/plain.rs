//! Members without a screen.

use super::*;
use crate::shell::plain::Plain;

/// Lets the host and the member run until something is so.
async fn until(
    host: &mut Aboard,
    member: &mut Plain,
    end: &mut CrewEnd,
    is_so: impl Fn(&Plain) -> bool,
) {
    for _ in 0..600 {
        if is_so(member) {
            return;
        }
        tokio::time::sleep(TICK).await;
        Box::pin(host.turn()).await;
        Box::pin(turn(member, end)).await;
    }
    panic!("it did not happen within a minute");
}

async fn turn(member: &mut Plain, end: &mut CrewEnd) {
    Box::pin(member.tick()).await.expect("it prints");
    let moment = Duration::from_millis(2);
    while let Ok(arrival) = tokio::time::timeout(moment, end.next()).await {
        Box::pin(member.console.attend_crew(end, arrival)).await;
    }
    member.console.tell_crew(end);
}

fn is_flying(member: &Plain) -> bool {
    let state = member.console.app.state();
    state.session().vehicles().len() == 3 && !has_debrief(member)
}

fn has_debrief(member: &Plain) -> bool {
    let state = member.console.app.state();
    state.rooms().debrief().session().is_some()
}

#[tokio::test]
async fn a_plain_member_stays_for_every_flight_and_ends_with_the_host() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let options = member_options(folder.path(), "anna", None);
    let mut end = CrewEnd::open(&options).expect("the crew opens");
    let mut anna = Plain::new(options, true);
    Box::pin(anna.begin()).await;
    until(&mut host, &mut anna, &mut end, is_flying).await;
    host.console.abandon();
    until(&mut host, &mut anna, &mut end, has_debrief).await;
    assert!(!anna.is_over());
    Box::pin(host.console.start_again(true))
        .await
        .expect("it starts");
    until(&mut host, &mut anna, &mut end, is_flying).await;
    assert!(!anna.is_over());
    let Aboard {
        mut console,
        end: mut end_of_host,
    } = host;
    Box::pin(console.close()).await;
    console.tell_crew(&mut end_of_host);
    let turns = async {
        for _ in 0..600 {
            if anna.is_over() {
                return;
            }
            Box::pin(turn(&mut anna, &mut end)).await;
        }
        panic!("it did not end with the host");
    };
    tokio::join!(end_of_host.close(), turns);
}
