//! How a recording is played: rate, direction, repeated sections, stops.

use super::*;

#[test]
fn a_stretch_is_played_over_and_over_at_a_rate() {
    let recorded = record();
    let (mut replay, _) = watched(&recorded);
    drop(replay.steer(ReplayEffect::Loop(Some(LoopTarget::Times {
        from: s(10),
        to: s(12),
    }))));
    drop(replay.steer(ReplayEffect::Rate(4.0)));
    let mut seen = Vec::new();
    for tick in 0..20 {
        drop(replay.tick(FRAME * tick));
        seen.push(replay.now().as_millis());
    }
    assert!(
        seen.iter().all(|at| (10_000..12_000).contains(at)),
        "{seen:?}"
    );
    assert_eq!(&seen[..4], [10_000, 10_400, 10_800, 11_200]);
    assert!(seen.windows(2).any(|two| two[1] < two[0]));
}

#[test]
fn frames_go_both_ways_and_the_end_is_the_end() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    seek(&mut replay, &mut observer, s(10));
    drop(replay.steer(ReplayEffect::Step { forward: false }));
    assert_eq!(replay.now() + FRAME, s(10));
    drop(replay.steer(ReplayEffect::Step { forward: true }));
    assert_eq!(replay.now(), s(10));
    drop(replay.steer(ReplayEffect::Seek(SeekTarget::End)));
    while replay.player.goal() >= replay.stage.now() + FRAME {
        drop(replay.approach());
    }
    assert!(replay.is_at_end());
    drop(replay.steer(ReplayEffect::Play(true)));
    assert_eq!(replay.now(), Duration::ZERO);
}

#[test]
fn it_plays_backwards_and_stops_at_what_comes_up() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    replay.wait_for_index();
    seek(&mut replay, &mut observer, s(20));
    drop(replay.steer(ReplayEffect::StopAt(vec![MomentKind::Refusal])));
    drop(replay.steer(ReplayEffect::Rewind));
    let mut now = Duration::ZERO;
    let mut seen = Vec::new();
    while replay.player.is_playing() {
        drop(replay.tick(now));
        seen.push(replay.now());
        now += FRAME;
    }
    assert!(
        seen.is_sorted_by(|earlier, later| earlier >= later),
        "{seen:?}"
    );
    assert_eq!(replay.now(), s(7) + FRAME, "the refusal can be seen");
    drop(replay.steer(ReplayEffect::StopAt(Vec::new())));
    drop(replay.steer(ReplayEffect::Rewind));
    while replay.player.is_playing() {
        drop(replay.tick(now));
        now += FRAME;
    }
    assert_eq!(replay.now(), Duration::ZERO);
    drop(replay.steer(ReplayEffect::Seek(SeekTarget::Next(MomentKind::Refusal))));
    while !replay.is_there() {
        drop(replay.tick(now));
    }
    assert_eq!(replay.now(), s(7) + FRAME);
}

#[test]
fn a_stretch_ends_with_the_recording() {
    let recorded = record();
    let (mut replay, _) = watched(&recorded);
    replay.wait_for_index();
    let length = replay.length();
    drop(replay.steer(ReplayEffect::Loop(Some(LoopTarget::Times {
        from: s(10),
        to: s(9999),
    }))));
    assert_eq!(replay.player.repeated(), Some((s(10), length)));
    let beyond = ReplayEffect::Loop(Some(LoopTarget::Times {
        from: s(9000),
        to: s(9999),
    }));
    let said = replay.steer(beyond);
    assert!(matches!(&said[..], [Event::Failed(_)]), "{said:?}");
    assert_eq!(replay.player.repeated(), Some((s(10), length)));
    let none = SeekTarget::Next(MomentKind::Rule);
    let said = replay.steer(ReplayEffect::Seek(none));
    assert!(matches!(&said[..], [Event::Failed(_)]), "{said:?}");
}

#[test]
fn a_stretch_lies_between_two_moments_of_a_kind() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    let bookmark = |at| Moment {
        at: s(at),
        vehicles: Vec::new(),
        kind: MomentKind::Bookmark,
        by: None,
        text: Text::verbatim("here"),
    };
    replay.contents.replace(vec![bookmark(10), bookmark(20)]);
    let bookmarks = || ReplayEffect::Loop(Some(LoopTarget::Moments(MomentKind::Bookmark)));
    seek(&mut replay, &mut observer, s(15));
    drop(replay.steer(bookmarks()));
    let looped = Some((s(10) + FRAME, s(20) + FRAME));
    assert_eq!(replay.player.repeated(), looped);
    assert_eq!(replay.player.goal(), s(10) + FRAME);
    for at in [5, 25] {
        seek(&mut replay, &mut observer, s(at));
        let said = replay.steer(bookmarks());
        assert!(matches!(&said[..], [Event::Failed(_)]), "{said:?}");
    }
    drop(replay.steer(ReplayEffect::Loop(None)));
    assert_eq!(replay.player.repeated(), None);
}
