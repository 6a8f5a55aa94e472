//! The buffer of tf2.

use periplus_geometry::{DQuat, DVec3};
use periplus_tf::{
    Buffer, CACHE_NS, LookupError, ResolvedTransform, StampedTransform, TransformCache,
    TransformKind, TransformLookup, TransformSample,
};

use serde_json::{Value, json};

use super::Setting;
use crate::{Case, CaseReader, Differences, Expected, Unreadable, number, numbers};

/// Seconds of a case as nanoseconds. Cases have them as decimal numbers.
fn ns(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

fn transform(given: &CaseReader<'_>) -> Result<(StampedTransform, TransformKind), Unreadable> {
    let vector = given.get("translation")?.array()?;
    let stamped = StampedTransform {
        parent: given.get("parent")?.text()?.into(),
        child: given.get("child")?.text()?.into(),
        stamp_ns: ns(given.get("stamp")?.number()?),
        translation: DVec3::from_array(vector),
        rotation: DQuat::from_array(given.get("rotation")?.array()?),
    };
    let is_static = given.find("static").map_or(Ok(false), |it| it.truth())?;
    Ok((stamped, if is_static { TransformKind::Fixed } else { TransformKind::Moving }))
}

fn buffer(given: &CaseReader<'_>) -> Result<Buffer, Unreadable> {
    let span_ns = given.find("cache_time").map_or(Ok(CACHE_NS), |it| it.number().map(ns))?;
    let authority = given.find("authority").map_or(Ok("default_authority"), |it| it.text())?;
    let mut buffer = Buffer::new(span_ns);
    for one in given.get("transforms")?.list()? {
        let (stamped, kind) = transform(&one)?;
        // What is refused is left out; whether it should be is another kind's question.
        let own = one.find("authority").map(|it| it.text()).transpose()?;
        let _ = buffer.set(&stamped, own.unwrap_or(authority), kind);
    }
    Ok(buffer)
}

/// Transforms that the buffer accepts.
pub(super) fn check_set(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let span_ns = given.find("cache_time").map_or(Ok(CACHE_NS), |it| it.number().map(ns))?;
    let mut buffer = Buffer::new(span_ns);
    let mut accepted = Vec::new();
    for one in given.get("transforms")?.list()? {
        let (stamped, kind) = transform(&one)?;
        accepted.push(buffer.set(&stamped, "default_authority", kind).is_ok());
    }
    differences.compare_members(&[(&["accepted"], json!(accepted))], &case.expect());
    Ok(())
}

/// In which order samples are kept, and which go.
pub(super) fn check_cache(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let mut samples = TransformCache::<&str>::new(given.get("max_storage")?.integer()?);
    let inserted = |name: &str| {
        let list = given.get(name)?;
        list.each(|one| match one.list()?.as_slice() {
            [name, stamp] => Ok((name.text()?, stamp.integer()?)),
            _ => Err(one.unreadable("a name and a stamp")),
        })
    };
    let insert = |samples: &mut TransformCache<_>, parent, stamp_ns| {
        let (translation, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        samples.insert(TransformSample { stamp_ns, parent, translation, rotation })
    };
    let order = |samples: &TransformCache<&str>| -> Value {
        samples.newest_first().map(|sample| json!(sample.parent)).collect()
    };
    let mut named: Vec<(&[&str], Value)> = Vec::new();
    let first = inserted("insert")?;
    for &(name, stamp_ns) in &first {
        insert(&mut samples, name, stamp_ns);
    }
    named.push((&["order_newest_first"], order(&samples)));
    if given.find("insert_again_reverse").map_or(Ok(false), |it| it.truth())? {
        for &(name, stamp_ns) in first.iter().rev() {
            insert(&mut samples, name, stamp_ns);
        }
        named.push((&["after_repeat"], order(&samples)));
    }
    if given.find("then_insert").is_some() {
        for (name, stamp_ns) in inserted("then_insert")? {
            insert(&mut samples, name, stamp_ns);
        }
        named.push((&["after_more"], order(&samples)));
    }
    differences.compare_members(&named, &case.expect());
    Ok(())
}

/// Queries: target, source and time; or target, its time, source, its time and a fixed frame.
pub(super) fn check_lookup(
    case: &Case,
    distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let given = case.given();
    let buffer = buffer(&given)?;
    let queries = given.get("queries")?.list()?;
    let order = given.find("query_fields").map(|it| it.text()).transpose()?;
    for (name, expected) in case.expect().members()? {
        if name != "results" {
            differences.not_known(format!("`{}` (known: `results`)", expected.path()));
            continue;
        }
        let results = expected.list()?;
        differences.same_count("results", queries.len(), results.len());
        for (query, expected) in queries.iter().zip(&results) {
            let got = Query::read(query, order)?.ask(&buffer);
            compare(query, &got, expected, distro, differences)?;
        }
    }
    Ok(())
}

/// Arguments of a lookup.
#[derive(Default)]
struct Query<'v> {
    target: &'v str,
    source: &'v str,
    time_ns: i64,
    /// Target time, source time and what stood still.
    across: Option<(i64, i64, &'v str)>,
}

impl<'v> Query<'v> {
    /// Reads a list, whose order the case may define, or an object.
    fn read(query: &CaseReader<'v>, order: Option<&str>) -> Result<Self, Unreadable> {
        let named: Vec<(String, CaseReader<'v>)> = match query.list() {
            Ok(words) => names(order, words.len())
                .ok_or_else(|| query.unreadable("target, source and time"))?
                .into_iter()
                .zip(words)
                .collect(),
            Err(_) => query.members()?.into_iter().map(|(name, it)| (name.into(), it)).collect(),
        };
        let find = |wanted: &[&str]| {
            named.iter().find(|(name, _)| wanted.contains(&name.as_str())).map(|(_, value)| value)
        };
        let text = |wanted: &[&str]| match find(wanted) {
            Some(value) => value.text(),
            None => Err(query.unreadable(&format!("a query with `{}`", wanted[0]))),
        };
        let time = |wanted: &[&str]| find(wanted).map_or(Ok(0), |value| value.number().map(ns));
        let fixed = find(&["fixed", "fixed_frame"]);
        let across = match fixed {
            Some(fixed) => Some((time(&["target_time"])?, time(&["source_time"])?, fixed.text()?)),
            None => None,
        };
        Ok(Self {
            target: text(&["target", "target_frame"])?,
            source: text(&["source", "source_frame"])?,
            time_ns: time(&["time", "stamp"])?,
            across,
        })
    }

    fn ask(&self, buffer: &Buffer) -> Result<ResolvedTransform, LookupError> {
        let &Self { target, source, time_ns, across } = self;
        match across {
            None => buffer.lookup(target, source, time_ns),
            Some((target_time_ns, source_time_ns, fixed)) => {
                buffer.lookup_across(TransformLookup {
                    target,
                    target_time_ns,
                    source,
                    source_time_ns,
                    fixed,
                })
            }
        }
    }
}

/// Names of the parts of a query: those that the case defines, as `target, source, time (0 =
/// latest)`, or the default ones.
fn names(order: Option<&str>, count: usize) -> Option<Vec<String>> {
    let told = order.map(|order| {
        let words = order.split(',').filter_map(|part| part.split_whitespace().next());
        words.map(str::to_owned).collect::<Vec<_>>()
    });
    let usual: &[&str] = match count {
        3 => &["target", "source", "time"],
        5 => &["target", "target_time", "source", "source_time", "fixed"],
        _ => &[],
    };
    told.filter(|told| told.len() == count)
        .or_else(|| Some(usual.iter().map(|&name| name.to_owned()).collect()))
        .filter(|names| names.len() == count)
}

fn compare(
    query: &CaseReader<'_>,
    got: &Result<ResolvedTransform, LookupError>,
    expected: &Expected<'_>,
    distro: &str,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let what = query.shown();
    if expected.is_null() {
        differences.compare(format_args!("{what} is found"), &found_value(got), expected);
        return Ok(());
    }
    let is_humble = distro == "humble";
    match got {
        Err(error) => {
            let class = error.kind.exception();
            // The base class stands for its subclasses, which Humble does not have.
            let is_same = |name: &Value| {
                let name = name.as_str().unwrap_or_default();
                let is_base = name == "ExtrapolationException" && error.kind.is_extrapolation();
                name == class || is_base
            };
            let shown = if is_humble { format!("{class} (or its base)") } else { class.to_owned() };
            if !expected.is_object() {
                differences.hold(&what, shown, expected, is_same);
                return Ok(());
            }
            for (name, expected) in expected.members()? {
                match name {
                    "exception" => differences.hold(&what, &shown, &expected, is_same),
                    "message" => differences.compare(&what, &json!(error.message), &expected),
                    // A pose was expected.
                    "translation" | "rotation" | "stamp" => {
                        differences.compare(&what, &json!(error.message), &expected);
                    }
                    _ => differences.not_known(format!("`{}`", expected.path())),
                }
            }
        }
        Ok(found) if expected.is_object() => {
            let pose = found.target_from_source;
            let mut got = json!({
                "translation": numbers(pose.translation.to_array()),
                "stamp": number(found.time_ns as f64 / 1e9),
            });
            if let Some(rotation) = expected.find("rotation") {
                let wanted = DQuat::from_array(rotation.input().array()?);
                // Both signs are the same rotation.
                let sign = if pose.rotation.dot(wanted) < 0.0 { -1.0 } else { 1.0 };
                got["rotation"] = numbers((pose.rotation * sign).to_array());
            }
            if expected.has("exception") {
                got["exception"] = Value::Null;
                got["message"] = Value::Null;
            }
            differences.compare(&what, &got, expected);
        }
        Ok(_) => differences.compare(&what, &json!("found"), expected),
    }
    Ok(())
}

/// Null where nothing was found.
fn found_value(got: &Result<ResolvedTransform, LookupError>) -> Value {
    if got.is_ok() { json!("found") } else { Value::Null }
}

/// Output of `allFramesAsYAML`.
pub(super) fn check_frames_yaml(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let now_ns = given.find("current_time").map(|it| it.number().map(ns)).transpose()?;
    let text = buffer(&given)?.frames_yaml(now_ns);
    let fields: Vec<(&str, &str)> =
        text.lines().filter_map(|line| line.strip_prefix("  ")?.split_once(": ")).collect();
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in &fields {
        if !names.contains(name) {
            names.push(name);
        }
    }
    let mut named: Vec<(&[&str], Value)> =
        vec![(&["fields"], json!(names)), (&["text"], json!(text))];
    let value = |wanted: &str| {
        let found = fields.iter().find(|(field, _)| *field == wanted);
        found.map_or(Value::Null, |(_, text)| match text.parse::<f64>() {
            Ok(value) => number(value),
            Err(_) => json!(text.trim_matches('\'')),
        })
    };
    let all: [&[&str]; 7] = [
        &["rate"],
        &["buffer_length"],
        &["most_recent_transform"],
        &["oldest_transform"],
        &["transform_delay"],
        &["parent"],
        &["broadcaster"],
    ];
    named.extend(all.map(|names| (names, value(names[0]))));
    differences.compare_members(&named, &expect);
    Ok(())
}
