//! Numbers of messages that are neither finite nor infinite by definition.

use std::collections::BTreeMap;

use periplus_msgs::{Count, DynamicMessage, Format, Number, Numbers, Sink, TypeRegistry};

/// Fields that hold infinity by definition: REP 117 has it for beams without a return. NaN is an error
/// in them, too: our sensors have no beams that fail.
const INFINITE: [(&str, &str); 2] =
    [("sensor_msgs/msg/LaserScan", "ranges"), ("sensor_msgs/msg/Range", "range")];

/// Counts messages, and those with numbers that are not finite.
#[derive(Default)]
pub(crate) struct FiniteCheck {
    pub(crate) messages: u64,
    pub(crate) numbers: u64,
    /// By topic and field: how many, and the time of the first \[s\].
    pub(crate) faults: BTreeMap<(String, String), (u64, f64)>,
}

impl FiniteCheck {
    /// Checks one message.
    ///
    /// # Errors
    /// When the type is unknown, or the bytes are not a message of it.
    pub(crate) fn check(
        &mut self,
        topic: &str,
        type_name: &str,
        time_s: f64,
        cdr: &[u8],
    ) -> Result<(), String> {
        let layout = TypeRegistry::builtin().layout(type_name);
        let layout = layout.ok_or_else(|| format!("{topic}: the type `{type_name}` is unknown"))?;
        let message = DynamicMessage::decode(layout, Format::CDR, cdr);
        let message = message.map_err(|error| format!("{topic} at {time_s} s: {error}"))?;
        let mut walk = Walk::default();
        message.write(&mut walk);
        self.messages += 1;
        self.numbers += walk.numbers;
        for field in walk.faults {
            let key = (topic.to_owned(), field.to_owned());
            self.faults.entry(key).or_insert((0, time_s)).0 += 1;
        }
        Ok(())
    }
}

/// A walk over the values of a message.
#[derive(Default)]
struct Walk {
    /// Types of the structures around the value.
    types: Vec<String>,
    field: String,
    numbers: u64,
    /// Fields with faults, one entry for each of them in the message.
    faults: Vec<String>,
}

impl Walk {
    fn see(&mut self, number: f64) {
        self.numbers += 1;
        let may_be_infinite = || {
            let of_type = self.types.last().map_or("", String::as_str);
            INFINITE.iter().any(|(name, field)| *name == of_type && *field == self.field)
        };
        if !number.is_finite() && (number.is_nan() || !may_be_infinite()) {
            self.faults.push(self.field.clone());
        }
    }
}

impl Sink for Walk {
    fn begin(&mut self, type_name: &str) {
        self.types.push(type_name.to_owned());
    }

    fn end(&mut self, _is_empty: bool) {
        self.types.pop();
    }

    fn field(&mut self, name: &str) {
        name.clone_into(&mut self.field);
    }

    fn number(&mut self, number: Number) {
        match number {
            Number::F32(number) => self.see(number.into()),
            Number::F64(number) => self.see(number),
            _ => {}
        }
    }

    fn text(&mut self, _text: &str, _limit: Option<u32>) {}

    fn wide_text(&mut self, _text: &str, _limit: Option<u32>) {}

    fn list(&mut self, _length: usize, _count: Count) {}

    fn end_list(&mut self) {}

    fn numbers(&mut self, numbers: Numbers<'_>) {
        match numbers {
            Numbers::F32(all) => all.iter().for_each(|number| self.see((*number).into())),
            Numbers::F64(all) => all.iter().for_each(|number| self.see(*number)),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::Message;
    use periplus_msgs::geometry_msgs::PoseStamped;
    use periplus_msgs::sensor_msgs::LaserScan;

    use super::*;

    #[track_caller]
    fn faults<T: Message>(message: &T) -> Vec<String> {
        let mut check = FiniteCheck::default();
        check.check("/topic", T::TYPE_NAME, 0.0, &message.to_cdr().unwrap()).unwrap();
        check.faults.into_keys().map(|(_, field)| field).collect()
    }

    #[test]
    fn nan_is_found_wherever_it_is() {
        let mut pose = PoseStamped::default();
        assert!(faults(&pose).is_empty());
        pose.pose.position.y = f64::NAN;
        assert_eq!(faults(&pose), ["y"]);
        pose.pose.position.y = f64::INFINITY;
        assert_eq!(faults(&pose), ["y"]);
    }

    #[test]
    fn ranges_of_a_scan_may_be_infinite() {
        let scan = |ranges: Vec<f32>| LaserScan { ranges, ..LaserScan::default() };
        assert!(faults(&scan(vec![1.0, f32::INFINITY])).is_empty());
        assert_eq!(faults(&scan(vec![1.0, f32::NAN])), ["ranges"]);
        let scan = LaserScan { angle_min: f32::INFINITY, ..scan(vec![1.0]) };
        assert_eq!(faults(&scan), ["angle_min"]);
    }
}
