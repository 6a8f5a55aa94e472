//! Differences of the topics of two recordings: counts, rates, and the first messages that differ.

use std::collections::hash_map::DefaultHasher;
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{Hash as _, Hasher as _};
use std::sync::atomic::{AtomicBool, Ordering};

use periplus_bags::files::{Bag, BagError};
use periplus_bags::{BagTopic, Selection};
use periplus_msgs::{DynamicMessage, Format};
use serde_json::{Value, json};

/// Maximum number of messages of a topic that are compared.
const MAX_COMPARED_COUNT: usize = 10_000_000;

/// Maximum number of values that are listed for a message.
const MAX_VALUE_COUNT: usize = 20;

/// Maximum length of a value as text \[characters\].
const MAX_VALUE_LENGTH: usize = 200;

/// Messages between two checks for a cancellation.
const CANCEL_CHECK_COUNT: usize = 1024;

/// Bytes of the stamp of a message that begins with a `std_msgs/msg/Header`, in CDR.
const STAMP_BYTES: std::ops::Range<usize> = 4..12;

/// Difference of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicDifference {
    /// Name.
    pub name: String,
    /// Type in the first and in the second recording; none where it is missing.
    pub types: [Option<String>; 2],
    /// Message counts; none where it is missing.
    pub counts: [Option<u64>; 2],
    /// Mean rates \[Hz\]; none where it is missing.
    pub rates_hz: [Option<f64>; 2],
    /// Number of messages that were compared, the Nth of one with the Nth of the other.
    pub compared_count: u64,
    /// First messages that differ; none if all that were compared are equal.
    pub first: Option<MessageDifference>,
}

/// Two messages that differ.
#[derive(Clone, Debug, PartialEq)]
pub struct MessageDifference {
    /// Number of the message on its topic, from 0.
    pub index: u64,
    /// Times of recording \[ns\].
    pub times_ns: [i64; 2],
    /// Values that differ, by their paths. Empty if the messages cannot be decoded.
    pub values: Vec<ValueDifference>,
    /// Number of values that differ, also of those that are not listed.
    pub value_count: usize,
}

/// A value that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValueDifference {
    /// Path, such as `pose.position.x` or `ranges[3]`.
    pub path: String,
    /// Values as JSON; empty where there is none.
    pub values: [String; 2],
}

impl TopicDifference {
    /// Returns the difference as JSON, as the page gets it.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let first = self.first.as_ref().map(|it| {
            let values: Vec<Value> = it
                .values
                .iter()
                .map(|value| json!({"path": value.path, "values": value.values}))
                .collect();
            // Times as text: numbers of JSON lose digits.
            json!({
                "index": it.index,
                "timesNs": it.times_ns.map(|time_ns| time_ns.to_string()),
                "values": values,
                "valueCount": it.value_count,
            })
        });
        json!({
            "topic": self.name,
            "types": self.types,
            "counts": self.counts,
            "ratesHz": self.rates_hz,
            "comparedCount": self.compared_count,
            "first": first,
        })
    }
}

/// Compares the topics of two recordings, sorted by name. Stamps in headers are left out where the recordings are of
/// different times. None if `is_cancelled` became true.
///
/// # Errors
/// When one of them cannot be read.
pub fn compare_topics(
    first: &Bag,
    second: &Bag,
    is_cancelled: &AtomicBool,
) -> Result<Option<Vec<TopicDifference>>, BagError> {
    let bags = [first, second];
    let topics = bags.map(|bag| {
        let counted = bag.topics().iter().zip(bag.counts());
        counted
            .map(|(topic, count)| (topic.name.clone(), (topic, *count)))
            .collect::<BTreeMap<_, _>>()
    });
    let spans = bags.map(|bag| bag.span_ns().unwrap_or_default());
    let is_same_time = spans[0].0 <= spans[1].1 && spans[1].0 <= spans[0].1;
    let common: BTreeSet<String> = topics[0]
        .iter()
        .filter(|(name, (topic, _))| {
            topics[1].get(*name).is_some_and(|(other, _)| is_comparable(topic, other))
        })
        .map(|(name, _)| name.clone())
        .collect();
    let with_stamp = |topic: &BagTopic| is_same_time || !begins_with_header(topic);
    let mut hashes: [BTreeMap<String, Vec<u64>>; 2] = [BTreeMap::new(), BTreeMap::new()];
    for (bag, hashes) in bags.into_iter().zip(&mut hashes) {
        if !read(bag, &common, is_cancelled, &mut |topic, _, data| {
            let all = hashes.entry(topic.name.clone()).or_default();
            if all.len() < MAX_COMPARED_COUNT {
                all.push(hash(data, with_stamp(topic)));
            }
        })? {
            return Ok(None);
        }
    }
    // Indexes of the first messages that differ.
    let mut wanted: BTreeMap<String, usize> = BTreeMap::new();
    let mut compared: BTreeMap<String, u64> = BTreeMap::new();
    for (name, all) in &hashes[0] {
        let others = hashes[1].get(name).map(Vec::as_slice).unwrap_or_default();
        compared.insert(name.clone(), all.len().min(others.len()) as u64);
        if let Some(index) = all.iter().zip(others).position(|(a, b)| a != b) {
            wanted.insert(name.clone(), index);
        }
    }
    let mut found = BTreeMap::new();
    if !wanted.is_empty() {
        let Some([a, b]) = pick_both(bags, &wanted, is_cancelled)? else { return Ok(None) };
        for (name, index) in wanted {
            let (Some(a), Some(b)) = (a.get(&name), b.get(&name)) else { continue };
            let (topic, _) = topics[0][&name];
            let all = differing_values(topic, &a.1, &b.1);
            let value_count = all.len();
            let values = all.into_iter().take(MAX_VALUE_COUNT).collect();
            let index = index as u64;
            let difference = MessageDifference { index, times_ns: [a.0, b.0], values, value_count };
            found.insert(name, difference);
        }
    }
    let names: BTreeSet<&String> = topics.iter().flat_map(BTreeMap::keys).collect();
    let durations_s = spans.map(|(start, end)| (end.saturating_sub(start) as f64 * 1e-9).max(1e-3));
    let differences = names.into_iter().map(|name| {
        let sides = [topics[0].get(name), topics[1].get(name)];
        let counts = sides.map(|side| side.map(|(_, count)| *count));
        let rate = |side: usize| counts[side].map(|count| count as f64 / durations_s[side]);
        TopicDifference {
            name: name.clone(),
            types: sides.map(|side| side.map(|(topic, _)| topic.type_name.clone())),
            counts,
            rates_hz: [rate(0), rate(1)],
            compared_count: compared.get(name).copied().unwrap_or_default(),
            first: found.remove(name),
        }
    });
    Ok(Some(differences.collect()))
}

fn is_comparable(first: &BagTopic, second: &BagTopic) -> bool {
    first.type_name == second.type_name && first.encoding == second.encoding
}

/// True for CDR messages whose first field is a header.
fn begins_with_header(topic: &BagTopic) -> bool {
    let schema = String::from_utf8_lossy(&topic.schema);
    let lines = schema.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    let mut fields = lines.filter(|line| !line.is_empty() && !line.contains('='));
    let first = fields.next().and_then(|field| field.split_whitespace().next());
    topic.encoding == "cdr"
        && matches!(first, Some("std_msgs/Header" | "std_msgs/msg/Header" | "Header"))
}

fn hash(data: &[u8], with_stamp: bool) -> u64 {
    let mut hasher = DefaultHasher::new();
    if with_stamp || data.len() < STAMP_BYTES.end {
        data.hash(&mut hasher);
    } else {
        data[..STAMP_BYTES.start].hash(&mut hasher);
        data[STAMP_BYTES.end..].hash(&mut hasher);
    }
    hasher.finish()
}

/// Visits all messages of topics. False if `is_cancelled` became true.
fn read(
    bag: &Bag,
    topics: &BTreeSet<String>,
    is_cancelled: &AtomicBool,
    visit: &mut dyn FnMut(&BagTopic, i64, &[u8]),
) -> Result<bool, BagError> {
    let selection = Selection { topics: Some(topics.clone()), ..Selection::default() };
    let mut messages = bag.messages(selection);
    let mut count = 0_usize;
    while let Some(message) = messages.next()? {
        if let Some(topic) = bag.topics().get(message.topic) {
            visit(topic, message.log_ns, message.data);
        }
        count += 1;
        if count.is_multiple_of(CANCEL_CHECK_COUNT) && is_cancelled.load(Ordering::Relaxed) {
            return Ok(false);
        }
    }
    Ok(!is_cancelled.load(Ordering::Relaxed))
}

/// Times and bytes of one message of each topic.
type Picked = BTreeMap<String, (i64, Vec<u8>)>;

fn pick_both(
    bags: [&Bag; 2],
    wanted: &BTreeMap<String, usize>,
    is_cancelled: &AtomicBool,
) -> Result<Option<[Picked; 2]>, BagError> {
    let topics: BTreeSet<String> = wanted.keys().cloned().collect();
    let mut picked = [Picked::new(), Picked::new()];
    for (bag, picked) in bags.into_iter().zip(&mut picked) {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        let is_complete = read(bag, &topics, is_cancelled, &mut |topic, time_ns, data| {
            let count = counts.entry(topic.name.clone()).or_default();
            if wanted.get(&topic.name) == Some(count) {
                picked.insert(topic.name.clone(), (time_ns, data.to_vec()));
            }
            *count += 1;
        })?;
        if !is_complete {
            return Ok(None);
        }
    }
    Ok(Some(picked))
}

/// Values that differ, in the order of their paths.
fn differing_values(topic: &BagTopic, first: &[u8], second: &[u8]) -> Vec<ValueDifference> {
    let format = match topic.encoding.as_str() {
        "cdr" => Format::CDR,
        _ => return Vec::new(),
    };
    let Some(layout) = topic.layout() else { return Vec::new() };
    let decode = |data: &[u8]| DynamicMessage::decode(&layout, format, data);
    let (Ok(first), Ok(second)) = (decode(first), decode(second)) else { return Vec::new() };
    let mut out = Vec::new();
    compare_values("", &first.to_json(), &second.to_json(), &mut out);
    out
}

fn compare_values(path: &str, first: &Value, second: &Value, out: &mut Vec<ValueDifference>) {
    if first == second {
        return;
    }
    match (first, second) {
        (Value::Object(first), Value::Object(second)) => {
            for (name, value) in first {
                let inner = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                compare_values(&inner, value, second.get(name).unwrap_or(&Value::Null), out);
            }
        }
        (Value::Array(first), Value::Array(second)) => {
            for index in 0..first.len().max(second.len()) {
                let inner = format!("{path}[{index}]");
                match (first.get(index), second.get(index)) {
                    (Some(a), Some(b)) => compare_values(&inner, a, b, out),
                    (a, b) => {
                        out.push(ValueDifference { path: inner, values: [a, b].map(text_of) });
                    }
                }
            }
        }
        (first, second) => {
            let values = [Some(first), Some(second)].map(text_of);
            out.push(ValueDifference { path: path.to_owned(), values });
        }
    }
}

/// A value as JSON, cut where it is long; empty without a value.
fn text_of(value: Option<&Value>) -> String {
    let text = value.map(ToString::to_string).unwrap_or_default();
    if text.chars().count() <= MAX_VALUE_LENGTH {
        return text;
    }
    text.chars().take(MAX_VALUE_LENGTH).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_compared_by_path() {
        let mut out = Vec::new();
        let first = json!({"a": 1, "b": {"c": [1, 2, 3]}, "d": "x"});
        let second = json!({"a": 1, "b": {"c": [1, 5]}, "d": "y"});
        compare_values("", &first, &second, &mut out);
        let shown: Vec<String> =
            out.iter().map(|it| format!("{} {}|{}", it.path, it.values[0], it.values[1])).collect();
        assert_eq!(shown, ["b.c[1] 2|5", "b.c[2] 3|", "d \"x\"|\"y\""]);
    }

    #[test]
    fn a_stamp_is_left_out_on_request() {
        let (a, b) = ([0_u8; 16], [0, 0, 0, 0, 9, 9, 9, 9, 9, 9, 9, 9, 0, 0, 0, 0]);
        assert_ne!(hash(&a, true), hash(&b, true));
        assert_eq!(hash(&a, false), hash(&b, false));
        let mut later = a;
        later[12] = 1;
        assert_ne!(hash(&a, false), hash(&later, false));
    }

    #[test]
    fn a_long_value_is_cut() {
        let value = Value::String("x".repeat(500));
        assert_eq!(text_of(Some(&value)).chars().count(), MAX_VALUE_LENGTH + 1);
    }
}
