//! A film of a mesh that changes: an SVG whose frames are shown one after the other, again and again.
//!
//! Each frame is a group that SMIL makes visible for its time. A viewer that shows no animations shows the last frame.
//! All frames have one canvas and one scale of colours, so a triangle that stays as it is does not change.

use std::io::{self, Write};

use super::film::{Film, Frame};
use crate::failure::counted;
use crate::formats::svg::{draw_dots, draw_hull, draw_triangles, side, write_head, Canvas, Classes};

/// Frames a second.
const RATE: usize = 10;
/// The last frame is shown for this many more frames before the film begins again.
const HOLD: usize = 10;
/// Colours of points and of the places of questions.
const POINT: &str = "#1d2b53";
const ASKED: &str = "#c2188b";

/// Writes a film. `places` are the places of its script, as doubles.
pub fn write_film(film: &Film, places: &[[f64; 2]], commands: usize, out: &mut dyn Write) -> io::Result<()> {
    let frames = &film.frames;
    let shown = frames.iter().flat_map(|frame| &frame.points).map(|&place| places[place as usize]);
    let canvas = Canvas::around(places, shown);
    let triangles = frames.iter().flat_map(|frame| &frame.triangles);
    let classes = Classes::of(triangles.map(|&triangle| side(canvas.corners(triangle))).collect());
    let most = frames.iter().map(|frame| frame.points.len()).max().unwrap_or(0);
    write_head(&canvas, &format!("A mesh that lives: {}", counted(commands, "command")), out)?;
    for (number, frame) in frames.iter().enumerate() {
        let is_last = number + 1 == frames.len();
        writeln!(out, "<g display=\"{}\">", if is_last { "inline" } else { "none" })?;
        write_times(number, frames.len(), out)?;
        draw_triangles(&frame.triangles, &canvas, &classes, out)?;
        draw_hull(&frame.hull, !frame.triangles.is_empty(), &canvas, out)?;
        draw_dots(frame.points.iter().map(|&place| canvas.vertex(place)), dot(most), POINT, out)?;
        let asked = frame.asked.iter().filter(|&&place| canvas.is_inside(places[place as usize]));
        draw_dots(asked.map(|&place| canvas.vertex(place)), dot(most), ASKED, out)?;
        write_caption(frame, commands, &canvas, out)?;
        writeln!(out, "</g>")?;
    }
    writeln!(out, "</svg>")
}

/// The width of a dot where there are `count` of them.
fn dot(count: usize) -> f64 {
    (3_000.0 / (count.max(1) as f64).sqrt()).clamp(60.0, 280.0)
}

/// Says when a frame is visible. A film of one frame is a picture.
fn write_times(number: usize, frames: usize, out: &mut dyn Write) -> io::Result<()> {
    if frames == 1 {
        return Ok(());
    }
    let total = frames + HOLD;
    // Neighbours have their common border from the same division, so there is no gap between them.
    let share = |frame: usize| format!("{:.6}", frame as f64 / total as f64);
    let (values, times) = match number {
        0 => ("inline;none", format!("0;{}", share(1))),
        _ if number + 1 == frames => ("none;inline", format!("0;{}", share(number))),
        _ => ("none;inline;none", format!("0;{};{}", share(number), share(number + 1))),
    };
    let seconds = total as f64 / RATE as f64;
    writeln!(
        out,
        "<animate attributeName=\"display\" calcMode=\"discrete\" values=\"{values}\" keyTimes=\"{times}\" \
         dur=\"{seconds:.1}s\" repeatCount=\"indefinite\"/>"
    )
}

/// Writes below the mesh how far the script is.
fn write_caption(frame: &Frame, commands: usize, canvas: &Canvas<'_>, out: &mut dyn Write) -> io::Result<()> {
    let (done, points) = (frame.commands, counted(frame.living, "point"));
    let [_, height] = canvas.size;
    writeln!(
        out,
        "<text x=\"500\" y=\"{:.0}\" font-family=\"sans-serif\" font-size=\"340\" fill=\"{POINT}\">{done} of {}, \
         {points}</text>",
        height - 100.0,
        counted(commands, "command")
    )
}
