//! `topic echo`.

use std::fmt::Write as _;
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::Sample;
use periplus_msgs::{DynamicMessage, Format, Layout};

use crate::failure::endless;
use crate::filter::Filter;
use crate::listen::{Listener, Next, hear};
use crate::show::{Form, Show};
use crate::{Failure, Outcome, QosRequest, Session};

/// Polling period for messages.
const POLL_PERIOD: Duration = Duration::from_millis(2);

/// Options of `topic echo`.
#[derive(Clone, Debug, Default)]
pub struct TopicEchoOptions {
    /// Message type, overriding that of the topic.
    pub type_name: Option<String>,
    /// Format settings.
    pub show: Show,
    /// `--raw`: print the serialized bytes.
    pub raw: bool,
    /// `--once`.
    pub once: bool,
    /// `--filter`.
    pub filter: Option<String>,
    /// `--timeout`: exit after this long without a message.
    pub timeout: Option<Duration>,
    /// `--no-lost-messages`.
    pub no_lost_messages: bool,
    /// `--qos-...`.
    pub qos: QosRequest,
}

/// Prints the messages of a topic.
///
/// # Errors
/// When there is no such topic or type, no message arrives in time, or the output cannot be
/// written.
pub fn echo(session: &mut Session<'_>, topic: &str, options: &TopicEchoOptions) -> Outcome {
    let filter = options.filter.as_deref().map(Filter::read).transpose()?;
    let type_name = options.type_name.as_deref();
    if let (Some(name), false) = (type_name, options.raw) {
        session.types.message(name)?;
    }
    let node = session.node(None)?;
    let open = Listener::open(session, &node, topic, type_name, &options.qos, true)?;
    let layout = match options.raw {
        true => None,
        false => Some(session.types.message(&open.type_name)?.clone()),
    };
    let mut listeners = vec![open];
    let mut heard = None;
    let mut rejected = 0_u64;
    let shown = std::cell::Cell::new(Duration::ZERO);
    let outcome = hear(
        session,
        &mut listeners,
        POLL_PERIOD,
        |session, _, sample, at| {
            shown.set(at);
            let is_shown = show(session, sample, layout.as_ref(), filter.as_ref(), options);
            match is_shown {
                Ok(false) => return Ok(Next::Go),
                Ok(true) => {}
                Err(Unshown::Unread(words)) => {
                    rejected += 1;
                    if rejected == 1 {
                        session.say(&format!("WARNING: a message cannot be decoded: {words}"));
                    }
                    return Ok(Next::Go);
                }
                Err(Unshown::Failure(failure)) => return Err(failure),
            }
            heard = Some(at);
            Ok(if options.once { Next::Done } else { Next::Go })
        },
        |session, listeners, now| {
            let (new, all) = listeners[0].losses();
            if new > 0 && !options.no_lost_messages {
                session.say(&format!(
                    "A message was lost!!!\n\ttotal count change:{new}\n\ttotal count: {all}---"
                ));
            }
            let is_late = |timeout| now.saturating_sub(shown.get()) >= timeout;
            Ok(if options.timeout.is_some_and(is_late) { Next::Done } else { Next::Go })
        },
    );
    match (outcome, heard) {
        (outcome @ Err(Failure::Interrupted), _) if !options.once => endless(outcome),
        (Ok(()), None) => {
            Err(Failure::failed(format!("no message received on {} in time", listeners[0].topic)))
        }
        (outcome, _) => outcome,
    }
}

enum Unshown {
    Unread(String),
    Failure(Failure),
}

impl<E: Into<Failure>> From<E> for Unshown {
    fn from(error: E) -> Self {
        Self::Failure(error.into())
    }
}

/// Prints one message; returns true if it passed the filter.
fn show(
    session: &mut Session<'_>,
    sample: &Sample,
    layout: Option<&Arc<Layout>>,
    filter: Option<&Filter>,
    options: &TopicEchoOptions,
) -> Result<bool, Unshown> {
    let cdr = sample.cdr().map_err(|error| Unshown::Unread(error.to_string()))?;
    let (mut text, form) = match layout {
        None => (python_bytes(cdr), Form::Yaml),
        Some(layout) => {
            let message = DynamicMessage::decode(layout, Format::CDR, cdr)
                .map_err(|error| Unshown::Unread(error.to_string()))?;
            if let Some(filter) = filter
                && !filter.wants(&message)?
            {
                return Ok(false);
            }
            (options.show.text(&message)?, options.show.form)
        }
    };
    if form == Form::Yaml {
        text.push_str("---\n");
    }
    session.out.write_all(text.as_bytes())?;
    session.out.flush()?;
    Ok(true)
}

/// Bytes in Python syntax.
fn python_bytes(bytes: &[u8]) -> String {
    let quote = if bytes.contains(&b'\'') && !bytes.contains(&b'"') { b'"' } else { b'\'' };
    let mut out = format!("b{}", char::from(quote));
    for byte in bytes {
        match byte {
            byte if *byte == b'\\' || *byte == quote => {
                out.push('\\');
                out.push(char::from(*byte));
            }
            b'\n' => out.push_str("\\n"),
            b'\r' => out.push_str("\\r"),
            b'\t' => out.push_str("\\t"),
            b' '..=b'~' => out.push(char::from(*byte)),
            byte => {
                let _ = write!(out, "\\x{byte:02x}");
            }
        }
    }
    out.push(char::from(quote));
    out.push('\n');
    out
}
