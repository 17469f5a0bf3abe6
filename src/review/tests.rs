use super::*;
use crate::record::Subject;

fn at(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

fn bookmark(seconds: u64, text: &str) -> Moment {
    Moment {
        at: at(seconds),
        vehicles: Vec::new(),
        kind: MomentKind::Bookmark,
        by: None,
        text: Text::verbatim(text),
    }
}

fn reviewed() -> Review {
    let head = Head {
        profile: Some("vera".to_owned()),
        ..Head::new(Subject::Mission("01-air-sample".to_owned()), 0)
    };
    let mut review = Review::of(Some(&head));
    "the wind was behind us".clone_into(&mut review.why);
    let improve = "watch the battery".to_owned();
    review
        .add(PointKind::Improve, at(72), improve)
        .expect("there is room");
    review
}

#[test]
fn a_review_is_read_as_it_was_written() {
    let mut review = reviewed();
    assert_eq!(review.mission.as_deref(), Some("01-air-sample"));
    assert_eq!(Review::read(&review.to_json()), Ok(review.clone()));
    review.remove_bookmark(&[bookmark(3, "up")], at(3));
    let again = Review::read(&review.to_json()).expect("it is good");
    assert_eq!(again.bookmarks(&[bookmark(3, "up")]), []);
}

#[test]
fn what_is_no_review_is_refused_with_the_reason() {
    let refused = |text: &str| Review::read(text).expect_err("it is none").to_string();
    assert!(refused("{}").contains("cannot be read"));
    let later = reviewed()
        .to_json()
        .replace("sortie_review\": 1", "sortie_review\": 7");
    assert!(refused(&later).contains('7'), "{}", refused(&later));
}

#[test]
fn three_points_of_a_kind_are_remembered_and_each_can_be_removed() {
    let mut review = reviewed();
    for text in ["two", "three"] {
        let added = review.add(PointKind::Improve, at(80), text.to_owned());
        assert_eq!(added, Ok(()));
    }
    let more = review.add(PointKind::Improve, at(81), "four".to_owned());
    assert!(more.expect_err("it is full").to_string().contains('3'));
    let kept = review.add(PointKind::Sustain, at(81), "steady".to_owned());
    assert_eq!(kept, Ok(()));
    assert!(review.remove(5).is_err() && review.remove(0).is_err());
    assert_eq!(review.remove(1), Ok(()));
    let left: Vec<&str> = review.points().iter().map(|it| it.text.as_str()).collect();
    assert_eq!(left, ["two", "three", "steady"]);
}

#[test]
fn bookmarks_are_those_of_the_record_until_one_is_changed() {
    let recorded = [bookmark(10, "up"), bookmark(40, "down")];
    let mut review = Review::default();
    assert_eq!(review.bookmarks(&recorded), recorded);
    review
        .set_bookmark(&recorded, at(20), "gate".to_owned())
        .expect("there is room");
    let now = review.bookmarks(&recorded);
    review
        .set_bookmark(&now, at(10), "took off".to_owned())
        .expect("there is room");
    let now = review.bookmarks(&recorded);
    let texts: Vec<String> = now.iter().map(|it| it.text.to_string()).collect();
    assert_eq!(texts, ["took off", "gate", "down"]);
    review.remove_bookmark(&now, at(40));
    assert_eq!(review.bookmarks(&recorded).len(), 2);
}
