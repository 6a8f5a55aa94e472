//! The buffer of tf2.

use periplus_base::{DQuat, DVec3};
use periplus_tf::{Buffer, CACHE_NS, Found, Kind, Lookup, LookupError, Sample, Samples, Stamped};

use super::Setting;
use crate::{Case, Differences, Reader, Unreadable};

/// Seconds of a case as nanoseconds. Cases have them as decimal numbers.
fn ns(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

fn transform(given: &Reader<'_>) -> Result<(Stamped, Kind), Unreadable> {
    let vector = given.get("translation")?.array()?;
    let stamped = Stamped {
        parent: given.get("parent")?.text()?.into(),
        child: given.get("child")?.text()?.into(),
        stamp_ns: ns(given.get("stamp")?.number()?),
        translation: DVec3::from_array(vector),
        rotation: DQuat::from_array(given.get("rotation")?.array()?),
    };
    let is_static = given.find("static").map_or(Ok(false), |it| it.truth())?;
    Ok((stamped, if is_static { Kind::Fixed } else { Kind::Moving }))
}

fn buffer(given: &Reader<'_>) -> Result<Buffer, Unreadable> {
    let span_ns = given.find("cache_time").map_or(Ok(CACHE_NS), |it| it.number().map(ns))?;
    let authority = given.find("authority").map_or(Ok("default_authority"), |it| it.text())?;
    let mut buffer = Buffer::new(span_ns);
    for one in given.get("transforms")?.list()? {
        let (stamped, kind) = transform(&one)?;
        // What is refused is left out; whether it should be is another kind's question.
        let _ = buffer.set(&stamped, authority, kind);
    }
    Ok(buffer)
}

/// Which transforms are taken.
pub(super) fn check_set(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expected) = (case.given(), case.expect().get("accepted")?.list()?);
    let transforms = given.get("transforms")?.list()?;
    differences.same("number of transforms", &transforms.len(), &expected.len());
    let mut buffer = Buffer::default();
    for (at, (one, expected)) in transforms.iter().zip(&expected).enumerate() {
        let (stamped, kind) = transform(one)?;
        let result = buffer.set(&stamped, "default_authority", kind);
        differences.same(
            format_args!("transform {at} {result:?} is taken"),
            &result.is_ok(),
            &expected.truth()?,
        );
    }
    Ok(())
}

/// In which order samples are kept, and which go.
pub(super) fn check_cache(
    case: &Case,
    _distro: &str,
    _setting: &Setting<'_>,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let (given, expect) = (case.given(), case.expect());
    let mut samples = Samples::<&str>::new(given.get("max_storage")?.integer()?);
    let inserted = |name: &str| {
        let list = given.get(name)?;
        list.each(|one| match one.list()?.as_slice() {
            [name, stamp] => Ok((name.text()?, stamp.integer()?)),
            _ => Err(one.unreadable("a name and a stamp")),
        })
    };
    let insert = |samples: &mut Samples<_>, parent, stamp_ns| {
        let (translation, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        samples.insert(Sample { stamp_ns, parent, translation, rotation })
    };
    let mut compare = |name: &str, samples: &Samples<&str>| {
        let order: Vec<&str> = samples.newest_first().map(|sample| sample.parent).collect();
        differences.same(name, &order, &expect.get(name)?.each(|it| it.text())?);
        Ok::<_, Unreadable>(())
    };
    let first = inserted("insert")?;
    for &(name, stamp_ns) in &first {
        insert(&mut samples, name, stamp_ns);
    }
    compare("order_newest_first", &samples)?;
    if given.find("insert_again_reverse").is_some() {
        for &(name, stamp_ns) in first.iter().rev() {
            insert(&mut samples, name, stamp_ns);
        }
        compare("after_repeat", &samples)?;
    }
    if given.find("then_insert").is_some() {
        for (name, stamp_ns) in inserted("then_insert")? {
            insert(&mut samples, name, stamp_ns);
        }
        compare("after_more", &samples)?;
    }
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
    let (queries, results) = (given.get("queries")?.list()?, case.expect().get("results")?.list()?);
    let order = given.find("query_fields").map(|it| it.text()).transpose()?;
    differences.same("number of results", &queries.len(), &results.len());
    for (query, expected) in queries.iter().zip(&results) {
        let got = Query::read(query, order)?.ask(&buffer);
        compare(query, &got, expected, distro, differences)?;
    }
    Ok(())
}

/// What is asked for.
#[derive(Default)]
struct Query<'v> {
    target: &'v str,
    source: &'v str,
    time_ns: i64,
    /// Target time, source time and what stood still.
    across: Option<(i64, i64, &'v str)>,
}

impl<'v> Query<'v> {
    /// A list in an order that the case may tell, or an object.
    fn read(query: &Reader<'v>, order: Option<&str>) -> Result<Self, Unreadable> {
        let named: Vec<(String, Reader<'v>)> = match query.list() {
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

    fn ask(&self, buffer: &Buffer) -> Result<Found, LookupError> {
        let &Self { target, source, time_ns, across } = self;
        match across {
            None => buffer.lookup(target, source, time_ns),
            Some((target_time_ns, source_time_ns, fixed)) => buffer.lookup_across(Lookup {
                target,
                target_time_ns,
                source,
                source_time_ns,
                fixed,
            }),
        }
    }
}

/// The names of the parts of a query: those that the case tells, as `target, source, time (0 =
/// latest)`, or the usual ones.
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
    query: &Reader<'_>,
    got: &Result<Found, LookupError>,
    expected: &Reader<'_>,
    distro: &str,
    differences: &mut Differences,
) -> Result<(), Unreadable> {
    let what = query.value().to_string();
    if expected.is_null() {
        differences.same(format_args!("{what} is found"), &got.is_ok(), &false);
        return Ok(());
    }
    // An exception by name, or by name and words.
    let exception = expected.value().as_str();
    let exception = exception.or(expected.find("exception").and_then(|it| it.value().as_str()));
    match (got, exception) {
        (Err(error), Some(name)) => {
            let mut class = error.kind.exception();
            // One class for all of them, wherever the case says so, and always in humble.
            if error.kind.is_extrapolation()
                && (name == "ExtrapolationException"
                    || distro == "humble" && name.ends_with("ExtrapolationException"))
            {
                class = name;
            }
            differences.same(&what, class, name);
            if let Some(words) = expected.find("message") {
                differences.same(&what, error.message.as_str(), words.text()?);
            }
        }
        (Err(error), None) => differences.push(format!("{what}: {error}")),
        (Ok(_), Some(name)) => differences.push(format!("{what}: found, expected {name}")),
        (Ok(found), None) => {
            let pose = found.target_from_source;
            if let Some(translation) = expected.find("translation") {
                let got = pose.translation.to_array();
                differences.all_near(
                    format_args!("{what}, translation"),
                    &got,
                    &translation.array::<3>()?,
                );
            }
            if let Some(rotation) = expected.find("rotation") {
                let expected = DQuat::from_array(rotation.array()?);
                // Both signs are the same rotation.
                let sign = if pose.rotation.dot(expected) < 0.0 { -1.0 } else { 1.0 };
                let got = (pose.rotation * sign).to_array();
                differences.all_near(format_args!("{what}, rotation"), &got, &expected.to_array());
            }
            if let Some(stamp) = expected.find("stamp") {
                differences.whole(format_args!("{what}, time"), found.time_ns, ns(stamp.number()?));
            }
        }
    }
    Ok(())
}

/// What is told of all frames.
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
    if let Some(expected) = expect.find("fields") {
        differences.same("fields", &names, &expected.each(|it| it.text())?);
    }
    if let Some(expected) = expect.find("text") {
        differences.same("text", text.as_str(), expected.text()?);
    }
    for name in
        ["rate", "buffer_length", "most_recent_transform", "oldest_transform", "transform_delay"]
    {
        let Some(expected) = expect.find(name) else { continue };
        let found = fields.iter().find(|(field, _)| *field == name);
        match found.and_then(|(_, value)| value.parse::<f64>().ok()) {
            Some(number) => differences.near(name, number, expected.number()?),
            None => differences.push(format!("`{name}` is missing in {text}")),
        }
    }
    Ok(())
}
