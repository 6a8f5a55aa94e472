//! `tf tree`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::frames::{Forest, Frame};
use periplus_os::{Machine, Stopwatch, sleep, unix_ns};
use periplus_resources::Store as _;
use periplus_tf::{TransformKind, TransformMonitor, display_time};
use serde_json::json;

use super::listen::Frames;
use crate::{Failure, Outcome, Session};

/// Polling period for transforms.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Options of `tf tree`.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Duration of listening.
    pub wait: Duration,
    /// Topic of dynamic transforms.
    pub moving: String,
    /// Topic of static transforms.
    pub fixed: String,
    /// Output files.
    pub pictures: Pictures,
}

/// Output files of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Pictures {
    /// Path of the files, without extension.
    pub stem: PathBuf,
    /// True to write SVG, too.
    pub svg: bool,
}

/// Listens to transforms and writes their tree for Graphviz (`.gv`) and as a drawing (`.pdf`), as
/// `view_frames` does; the tree as text goes to the output.
///
/// Source: `tf2_tools/view_frames.py`.
///
/// # Errors
/// When no transform was received or files cannot be written.
pub fn tree(session: &mut Session<'_>, tree: &Tree) -> Outcome {
    let mut frames = Frames::of(session, [&tree.moving, &tree.fixed])?;
    session.say(&format!("Listening to tf data for {:?} seconds...", tree.wait.as_secs_f64()));
    let clock = Stopwatch::start();
    while clock.elapsed() < tree.wait {
        frames.hear(session);
        session.check_interrupted()?;
        sleep(POLL_PERIOD);
    }
    let mut forest = Forest::new(&frames.survey);
    // Messages do not identify their sender. If only one node publishes the topic, it is that node.
    let seen = session.network.seen();
    for (topic, kind) in
        [(&tree.moving, TransformKind::Moving), (&tree.fixed, TransformKind::Fixed)]
    {
        let ends = seen.topic(&crate::session::full_name(topic)).map(|topic| &topic.publishers);
        if let Some([only]) = ends.map(Vec::as_slice)
            && let Some(node) = &only.node
        {
            forest.set_broadcaster(kind, node);
        }
    }
    put_tree(session, &forest, &frames.survey, unix_ns(), &tree.pictures)?;
    if forest.frames().next().is_none() {
        let moving = seen.topic("/tf").map_or(0, |topic| topic.publishers.len());
        let fixed = seen.topic("/tf_static").map_or(0, |topic| topic.publishers.len());
        return Err(Failure::failed(format!(
            "no transform was received in {:?} s: publishers of {}: {moving}, of {}: {fixed}; start what \
             publishes them (robot_state_publisher, odometry), or see `periplus doctor`",
            tree.wait.as_secs_f64(),
            tree.moving,
            tree.fixed
        )));
    }
    Ok(())
}

/// Writes the files and the tree as text, and the problems of the tree.
///
/// # Errors
/// When files or the output cannot be written.
pub fn put_tree(
    session: &mut Session<'_>,
    forest: &Forest,
    survey: &TransformMonitor,
    recorded_ns: i64,
    pictures: &Pictures,
) -> Outcome {
    let recorded_at = display_time(recorded_ns);
    let mut files =
        vec![("gv", forest.dot(&recorded_at).into_bytes()), ("pdf", forest.pdf(&recorded_at))];
    if pictures.svg {
        files.push(("svg", forest.svg(&recorded_at).into_bytes()));
    }
    let mut written = Vec::new();
    for (ending, bytes) in files {
        let path = with_ending(&pictures.stem, ending);
        Machine
            .replace(&path, &bytes)
            .map_err(|why| Failure::failed(format!("cannot write {}: {why}", path.display())))?;
        written.push(path.display().to_string());
    }
    for fault in forest.faults() {
        session.say(&format!("WARNING: {fault}"));
    }
    for name in survey.with_slash() {
        session.say(&format!("WARNING: `{name}` has a leading slash, which tf2 strips"));
    }
    if session.json {
        return session.put(&as_json(forest, recorded_ns, &written));
    }
    write!(session.out, "{}", in_words(forest))?;
    session.out.flush()?;
    session.say(&format!("written: {}", written.join(", ")));
    Ok(())
}

fn with_ending(stem: &Path, ending: &str) -> PathBuf {
    // `with_extension` would replace parts of a dated name, which has dots in it.
    let mut path = stem.as_os_str().to_owned();
    path.push(format!(".{ending}"));
    path.into()
}

/// Tree with one frame per line.
fn in_words(forest: &Forest) -> String {
    let mut text = String::new();
    for (depth, frame, is_last) in forest.lines() {
        let mut stem: String = is_last
            .iter()
            .take(depth.saturating_sub(1))
            .map(|last| if *last { "   " } else { "\u{2502}  " })
            .collect();
        if depth > 0 {
            stem += if is_last[depth - 1] { "\u{2514}\u{2500} " } else { "\u{251c}\u{2500} " };
        }
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{stem}{}{}", frame.name, facts(frame));
    }
    text
}

fn facts(frame: &Frame) -> String {
    let Some(edge) = &frame.edge else { return String::new() };
    match edge.kind {
        TransformKind::Fixed => format!("  (static, {})", edge.broadcaster),
        TransformKind::Moving => format!("  ({:.1} Hz, {})", edge.rate_hz, edge.broadcaster),
    }
}

fn as_json(forest: &Forest, recorded_ns: i64, files: &[String]) -> serde_json::Value {
    let frames: Vec<_> = forest
        .frames()
        .map(|frame| {
            let edge = frame.edge.as_ref().map(|edge| {
                json!({
                    "parent": edge.parent, "broadcaster": edge.broadcaster,
                    "static": edge.kind == TransformKind::Fixed, "rate_hz": edge.rate_hz,
                    "newest_ns": edge.newest_ns, "oldest_ns": edge.oldest_ns,
                    "buffer_length_s": (edge.newest_ns - edge.oldest_ns) as f64 * 1e-9,
                    "other_parents": frame.other_parents,
                })
            });
            json!({ "frame": frame.name, "transform": edge })
        })
        .collect();
    let faults: Vec<_> = forest.faults().iter().map(ToString::to_string).collect();
    json!({
        "recorded_ns": recorded_ns, "roots": forest.roots().collect::<Vec<_>>(), "frames": frames,
        "faults": faults, "files": files,
    })
}
