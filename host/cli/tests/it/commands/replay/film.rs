//! Tests of `replay --film`: which frames there are, when each is visible, and what they show.

use crate::common::Scratch;

/// The frames of a film: the text of each group.
fn frames(film: &str) -> Vec<&str> {
    film.split("<g display=").skip(1).collect()
}

/// The value of an attribute at its first place in a text.
fn attribute<'a>(text: &'a str, name: &str) -> &'a str {
    let (_, rest) = text.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("no {name} in {text}"));
    rest.split('"').next().unwrap_or_default()
}

/// Whether a frame is visible at this share of the film.
fn is_visible(frame: &str, share: f64) -> bool {
    let values = attribute(frame, "values").split(';');
    let times = attribute(frame, "keyTimes").split(';').map(|time| time.parse::<f64>().expect("a share"));
    let times: Vec<f64> = times.collect();
    assert!(times[0] == 0.0 && times.windows(2).all(|pair| pair[0] < pair[1]) && times[times.len() - 1] < 1.0);
    values.zip(times).take_while(|&(_, time)| time <= share).last().is_some_and(|(value, _)| value == "inline")
}

#[test]
fn one_frame_is_visible_at_every_time() {
    let scratch = Scratch::new();
    scratch.run("generate churn -n 30 --commands 1000 -o s.txt").ok();
    for count in [2, 3, 7, 120, 600] {
        scratch.run(&format!("replay s.txt --film f.svg --frames {count} -q")).ok();
        let film = scratch.read("f.svg");
        let all = frames(&film);
        assert!(all.len() <= count && all.len() > count / 2, "{}", all.len());
        let mut order = Vec::new();
        for moment in 0..2000 {
            let visible: Vec<usize> =
                (0..all.len()).filter(|&frame| is_visible(all[frame], f64::from(moment) / 2000.0)).collect();
            assert_eq!(visible.len(), 1, "{moment}");
            order.extend(visible);
        }
        order.dedup();
        assert!(order.into_iter().eq(0..all.len()));
        // A viewer without animations shows the last frame.
        let first_values: Vec<bool> = all.iter().map(|frame| frame.starts_with("\"inline\"")).collect();
        assert!(first_values.iter().enumerate().all(|(frame, &shown)| shown == (frame + 1 == all.len())));
    }
}

#[test]
fn frames_are_the_meshes_on_the_way() {
    let scratch = Scratch::new();
    let commands = ["insert 0 0", "insert 4 0", "insert 0 4", "insert 4 4", "delete 1", "locate 1 1", "move 2 3 1"];
    scratch.write("s.txt", commands.join("\n"));
    scratch.run("replay s.txt --film f.svg --frames 7 -q").ok();
    let film = scratch.read("f.svg");
    let all = frames(&film);
    let triangles: Vec<usize> = all.iter().map(|frame| frame.matches('l').count()).collect();
    // The letter stands for each triangle, and in names of attributes, of which every frame has as many.
    let names = triangles[0];
    let counts: Vec<usize> = triangles.iter().map(|count| count.saturating_sub(names)).collect();
    assert!(counts[3] > counts[2] && counts[4] < counts[3], "{counts:?}");
    for (frame, text) in all.iter().enumerate() {
        let points = [1, 2, 3, 4, 3, 3, 3][frame];
        let caption =
            format!(">{} of 7 commands, {points} point{}</text>", frame + 1, if points == 1 { "" } else { "s" });
        assert!(text.contains(&caption), "{caption} in {text}");
        // The place of the question shows in one frame.
        assert_eq!(text.contains("#c2188b"), frame == 5, "{frame}");
    }
    // With an even number of commands between, the last frame still shows the end.
    scratch.run("replay s.txt --film f.svg --frames 2 -q").ok();
    let film = scratch.read("f.svg");
    let captions: Vec<&str> =
        frames(&film).iter().filter_map(|frame| frame.split_once("\">4 of").map(|_| "4")).collect();
    assert_eq!(captions, ["4"]);
    assert!(frames(&film)[1].contains(">7 of 7 commands, 3 points<"));
}

#[test]
fn films_of_nothing_are_pictures() {
    let scratch = Scratch::new();
    for script in ["#", "locate 1 2", "insert 5 5", "insert 5 5\ninsert 5 5", "insert 1e300 0\ninsert -1e300 0"] {
        scratch.write("s.txt", script);
        scratch.run("replay s.txt --film f.svg -q").ok();
        let film = scratch.read("f.svg");
        assert!(film.starts_with("<svg ") && film.ends_with("</svg>\n"), "{film}");
        assert!(!film.contains("NaN") && !film.contains("inf"), "{film}");
        assert!(frames(&film).len() == script.lines().count().max(1));
    }
}

#[test]
fn too_many_points_and_triangles_are_bounded() {
    let scratch = Scratch::new();
    let rows = |count: u32| -> String { (0..count).map(|k| format!("insert {} {}\n", k * k % 1009, k)).collect() };
    scratch.write("s.txt", rows(2001));
    let parts = ["a film shows up to 2000 points at one time, and in this script 2001 live", "--film"];
    scratch.run("replay s.txt -o m.obj --film f.svg").fails(2, &parts);
    assert_eq!(scratch.files(), ["s.txt"]);
    // Deleted points do not count.
    scratch.write("s.txt", format!("{}delete 7\ninsert 1 1\n", rows(2000)));
    let run = scratch.run("replay s.txt -o m.obj --film f.svg --frames 600").ok();
    assert!(run.stderr.contains("film: 96 frames, one after every 21 commands"), "{run:?}");
    let size = scratch.read("f.svg").len();
    assert!(size < 16 << 20, "{size}");
}
