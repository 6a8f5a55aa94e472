//! Validation of a bag: checksums, indexes, and decoding of every message.

use std::collections::BTreeMap;

use crate::{Selection, Target, Translation};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_os::fs;

use crate::files::{Bag, BagError, Storage};

/// Maximum size of MCAP files that are validated strictly \[bytes\]; of larger ones only the chunk
/// checksums are verified.
const STRICT: u64 = 256 << 20;

/// Number of messages between two progress callbacks.
const STEP: u64 = 256;

/// Reads and decodes all messages. Returns their number and the findings.
///
/// # Errors
/// When a file becomes unreadable.
pub fn check(bag: &Bag, progress: &mut dyn FnMut(u64)) -> Result<(u64, Diagnostics), BagError> {
    let mut findings = Diagnostics::new();
    for path in bag.files() {
        let bytes = fs::metadata(path).map_err(BagError::file(path))?.len();
        let is_mcap = Storage::of_path(path) == Some(Storage::Mcap);
        if is_mcap && bytes <= STRICT {
            for fault in crate::check(&fs::read(path).map_err(BagError::file(path))?) {
                let wrong = format!("`{}`: {fault}", path.display());
                findings.push(Diagnostic::warning("bad-mcap", wrong));
            }
        }
    }
    // A message that can be converted to the other encoding was decoded completely.
    let opposite = |encoding: &str| if encoding == "ros1" { Target::Ros2 } else { Target::Ros1 };
    let mut ways: Vec<Option<Translation>> = Vec::new();
    for topic in bag.topics() {
        let mut unused = Diagnostics::new();
        let way = Translation::new(topic, opposite(&topic.encoding), &mut unused);
        if way.is_none() {
            let wrong = format!(
                "messages of `{}` (type `{}`, encoded as `{}`) cannot be decoded",
                topic.name, topic.type_name, topic.encoding
            );
            findings.push(Diagnostic::hint("unknown-type", wrong));
        }
        ways.push(way);
    }
    let mut bad: BTreeMap<usize, (u64, String)> = BTreeMap::new();
    let mut counts = vec![0_u64; bag.topics().len()];
    let mut total = 0;
    let mut messages = bag.messages(Selection::default());
    while let Some(message) = messages.next()? {
        total += 1;
        counts[message.topic] += 1;
        if let Some(Some(way)) = ways.get_mut(message.topic)
            && let Err(error) = way.translate(message.data)
        {
            let (count, _) = bad.entry(message.topic).or_insert((0, error.to_string()));
            *count += 1;
        }
        if total % STEP == 0 {
            progress(total);
        }
    }
    for fault in messages.faults() {
        // Damage found at opening was reported already.
        findings.push(Diagnostic::warning("damaged-bag", fault.clone()));
    }
    for (topic, (count, error)) in bad {
        let name = &bag.topics()[topic].name;
        let wrong =
            format!("{count} messages of `{name}` cannot be decoded as their type: {error}");
        findings.push(Diagnostic::warning("bad-message", wrong));
    }
    for ((topic, count), declared) in bag.topics().iter().zip(&counts).zip(bag.counts()) {
        if count != declared {
            let wrong =
                format!("`{}` has {count} messages, but {declared} are declared", topic.name);
            findings.push(Diagnostic::warning("wrong-count", wrong));
        }
    }
    compare_metadata(bag, total, &mut findings);
    Ok((total, findings))
}

/// Compares `metadata.yaml` with the content.
fn compare_metadata(bag: &Bag, total: u64, findings: &mut Diagnostics) {
    let Some(metadata) = bag.metadata() else { return };
    let declared = metadata.info.messages();
    if declared != total {
        let wrong = format!("metadata.yaml declares {declared} messages, but there are {total}");
        findings.push(
            Diagnostic::warning("wrong-metadata", wrong).help("`periplus bag reindex` rewrites it"),
        );
    }
}
