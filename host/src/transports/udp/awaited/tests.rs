//! The fates of answers, number by number.

use super::*;
use incircle_protocol::signed_header;

const GRACE: Duration = Duration::from_micros(200);

fn asked(unit: u64, question: usize) -> Asked {
    Asked { unit, run: 0, question, words: 10 }
}

fn answer(engine: u8, tag: u8) -> Vec<u32> {
    vec![signed_header(0x0700_0000, engine, tag), 0]
}

/// The fates that are known now.
fn fates(awaited: &mut Awaited) -> Vec<Outcome> {
    std::iter::from_fn(|| awaited.next().expect("sound answers")).collect()
}

/// Two jobs with two questions each, on a device of two engines.
fn two_jobs() -> (Awaited, [u8; 2]) {
    let mut awaited = Awaited::new(2);
    let tags = [1, 2].map(|unit| {
        let tag = awaited.new_tag().expect("several engines");
        (0..2).for_each(|question| awaited.ask(tag, asked(unit, question), 8));
        tag
    });
    (awaited, tags)
}

#[test]
fn the_tag_tells_the_job_and_the_order_the_question() {
    let (mut awaited, [first, second]) = two_jobs();
    let order = [(second, 0), (first, 1), (second, 0), (first, 1)];
    // Answer 1 overtakes answer 0, and waits for it.
    for number in [1, 0, 2, 3] {
        let (tag, engine) = order[number as usize];
        assert_eq!(awaited.take(number, &answer(engine, tag), 8), Ok(true));
    }
    let came = |fate| if let Outcome::Came(asked, _) = fate { (asked.unit, asked.question) } else { (0, 9) };
    let all: Vec<_> = fates(&mut awaited).into_iter().map(came).collect();
    assert_eq!(all, [(2, 0), (1, 0), (2, 1), (1, 1)]);
    assert!(awaited.is_settled() && awaited.words() == 0);
    assert_eq!(awaited.take(3, &answer(0, second), 8), Ok(false), "doubled on the way");
}

#[test]
fn a_lost_answer_that_two_jobs_may_have_lost_begins_both_again() {
    let (mut awaited, [first, second]) = two_jobs();
    assert_eq!(awaited.take(0, &answer(0, first), 8), Ok(true));
    assert_eq!(awaited.take(2, &answer(1, second), 8), Ok(true));
    awaited.count(Duration::ZERO, GRACE, false);
    assert_eq!((fates(&mut awaited).len(), awaited.lost_at(GRACE)), (1, Some(GRACE)));
    awaited.count(GRACE, GRACE, false);
    let after = fates(&mut awaited);
    assert_eq!(after[0], Outcome::LostOfOne(vec![(1, 0), (2, 0)]));
    assert!(matches!(after[1], Outcome::Came(Asked { unit: 2, .. }, _)));
    // No new job gets the tag of an answer that may still come.
    assert!((0..300).all(|_| awaited.new_tag().is_some_and(|tag| tag != first && tag != second)));
    // The engine of the first job answers to a third one, so the first job gets no more answers.
    let third = awaited.new_tag().expect("several engines");
    awaited.ask(third, asked(3, 0), 8);
    assert_eq!(awaited.take(3, &answer(0, third), 8), Ok(true));
    assert!(matches!(fates(&mut awaited)[..], [Outcome::Came(Asked { unit: 3, .. }, _)]));
    // What is lost now can only be of the second job.
    awaited.passed(5, 8).expect("so many were asked");
    (0..9).for_each(|_| awaited.count(GRACE, GRACE, true));
    assert_eq!(fates(&mut awaited), [], "the answer may be late");
    awaited.count(2 * GRACE, GRACE, false);
    assert_eq!(fates(&mut awaited), [Outcome::Lost(asked(2, 1))]);
    assert!(awaited.is_settled() && awaited.words() == 0);
}

#[test]
fn one_engine_needs_no_tag() {
    let mut awaited = Awaited::new(1);
    assert_eq!(awaited.new_tag(), None);
    (0..3).for_each(|question| awaited.ask(0, asked(question, question as usize), 8));
    assert_eq!(awaited.take(1, &answer(0, 77), 8), Ok(true));
    (0..=OVERTAKEN).for_each(|_| awaited.count(Duration::ZERO, GRACE, true));
    let all = fates(&mut awaited);
    assert_eq!(all[0], Outcome::Lost(asked(0, 0)));
    assert!(matches!(all[1], Outcome::Came(Asked { unit: 1, .. }, _)));
    assert_eq!(awaited.words(), 10);
}

#[test]
fn answers_that_nobody_asked_for_are_a_fault() {
    let (mut awaited, [first, _]) = two_jobs();
    assert_eq!(awaited.take(4, &answer(0, first), 8), Err(UdpFault::Unasked { number: 4 }));
    assert_eq!(awaited.take(0, &answer(0, first), 7), Err(UdpFault::Unasked { number: 0 }), "before the question");
    assert_eq!(awaited.passed(5, 8), Err(UdpFault::Unasked { number: 4 }));
    assert_eq!(awaited.take(0, &answer(0, first + 9), 8), Ok(true));
    assert_eq!(awaited.next(), Err(UdpFault::Unasked { number: 0 }), "no job has this tag");
}
