//! Conversion of bags.

use std::collections::BTreeMap;

use crate::{BagInfo, Selection, Stamp, Target, Translation};
use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::files::stream::BagMessages;
use crate::files::{Bag, BagError, BagWriter, Storage, WriteSettings};

/// Input selection and output format of a conversion.
#[derive(Clone, Debug)]
pub struct Conversion {
    /// Messages to convert.
    pub selection: Selection,
    /// Settings of the output.
    pub write: WriteSettings,
}

/// Result of a conversion.
#[derive(Debug)]
pub struct Report {
    /// Content of the output.
    pub info: BagInfo,
    /// Size of all messages read \[bytes\].
    pub bytes: u64,
    /// Messages and topics left out, with the reasons.
    pub findings: Diagnostics,
}

/// Maximum number of messages between two progress callbacks.
const STEP: u64 = 256;

/// Writes the messages of several bags to a new one in the order of time, converting between ROS 1
/// and ROS 2. `progress` gets the number of messages done.
///
/// # Errors
/// When an input becomes unreadable or the output cannot be written. A message that cannot
/// be converted is left out with a finding.
pub fn convert(
    bags: &[Bag],
    output: impl AsRef<std::path::Path>,
    conversion: Conversion,
    progress: &mut dyn FnMut(u64),
) -> Result<Report, BagError> {
    let target =
        if conversion.write.storage == Storage::Ros1 { Target::Ros1 } else { Target::Ros2 };
    let mut findings = Diagnostics::new();
    let custom_data = common_data(bags, &conversion.write);
    let mut writer = BagWriter::create(output, WriteSettings { custom_data, ..conversion.write })?;
    let mut inputs = Vec::new();
    for bag in bags {
        inputs.push(Input::new(bag, &conversion.selection, target, &mut writer, &mut findings)?);
    }
    let (mut count, mut bytes) = (0, 0);
    while let Some(at) = earliest(&mut inputs)? {
        bytes += inputs[at].pass(&mut writer, &mut findings)?;
        count += 1;
        if count % STEP == 0 {
            progress(count);
        }
    }
    progress(count);
    for input in &inputs {
        for fault in input.messages.faults() {
            findings.push(Diagnostic::warning("damaged-bag", fault.clone()));
        }
    }
    Ok(Report { info: writer.finish()?, bytes, findings })
}

/// Facts of the recorders that all bags have, and those of the settings.
fn common_data(bags: &[Bag], write: &WriteSettings) -> BTreeMap<String, String> {
    let mut data = bags.first().map(Bag::custom_data).cloned().unwrap_or_default();
    data.retain(|name, value| bags.iter().all(|bag| bag.custom_data().get(name) == Some(value)));
    data.extend(write.custom_data.clone());
    data
}

/// Index of the bag with the earliest next message.
fn earliest(inputs: &mut [Input]) -> Result<Option<usize>, BagError> {
    if let [only] = inputs {
        return Ok(only.messages.peek_ns()?.map(|_| 0));
    }
    let mut first: Option<(i64, usize)> = None;
    for (at, input) in inputs.iter_mut().enumerate() {
        if let Some(time_ns) = input.messages.peek_ns()?
            && first.is_none_or(|(before_ns, _)| time_ns < before_ns)
        {
            first = Some((time_ns, at));
        }
    }
    Ok(first.map(|(_, at)| at))
}

struct Input {
    messages: BagMessages,
    /// Per topic: its conversion and its index in the output; none if it is left out.
    ways: Vec<Option<(Translation, usize)>>,
    lost: Vec<u64>,
}

impl Input {
    fn new(
        bag: &Bag,
        selection: &Selection,
        target: Target,
        writer: &mut BagWriter,
        findings: &mut Diagnostics,
    ) -> Result<Self, BagError> {
        let wanted =
            |name: &String| selection.topics.as_ref().is_none_or(|names| names.contains(name));
        let mut ways = Vec::new();
        for topic in bag.topics() {
            let is_foreign = target == Target::Ros2 && !["cdr", "ros1"].contains(&&*topic.encoding);
            let way = match wanted(&topic.name) {
                // A ROS 2 bag can store any encoding unchanged.
                true if is_foreign => Some(Translation::untouched(topic)),
                true => Translation::new(topic, target, findings),
                false => None,
            };
            ways.push(match way {
                Some(way) => {
                    let id = writer.topic(way.topic())?;
                    Some((way, id))
                }
                None => None,
            });
        }
        let lost = vec![0; ways.len()];
        Ok(Self { messages: bag.messages(selection.clone()), ways, lost })
    }

    /// Writes the next message. Returns its size \[bytes\].
    fn pass(
        &mut self,
        writer: &mut BagWriter,
        findings: &mut Diagnostics,
    ) -> Result<u64, BagError> {
        let Some(message) = self.messages.next()? else { return Ok(0) };
        let bytes = message.data.len() as u64;
        let Some(Some((way, id))) = self.ways.get_mut(message.topic) else { return Ok(bytes) };
        let stamp = Stamp {
            log_ns: message.log_ns,
            publish_ns: message.publish_ns,
            sequence: Some(message.sequence).filter(|&sequence| sequence > 0),
        };
        let name = way.topic().name.clone();
        match way.translate(message.data) {
            Ok(data) => writer.write(*id, stamp, data)?,
            Err(error) => {
                self.lost[message.topic] += 1;
                // One finding per topic.
                if self.lost[message.topic] == 1 {
                    let wrong = format!("a message of `{name}` cannot be converted: {error}");
                    findings.push(
                        Diagnostic::warning("bad-message", wrong)
                            .help("it is left out, as are all others that cannot be converted"),
                    );
                }
            }
        }
        Ok(bytes)
    }
}
