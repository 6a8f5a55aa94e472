//! Faults from YAML.

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_params::Table;
use periplus_yaml::{YamlNode, YamlValue};

use crate::kinds::FaultKind;
use crate::section::read_section;

/// A fault with its time window.
#[derive(Clone, Debug, PartialEq)]
pub struct InjectedFault {
    /// Kind with its parameters.
    pub kind: FaultKind,
    /// Start in simulated time \[s\].
    pub from_s: f64,
    /// End in simulated time \[s\]; infinite without one.
    pub until_s: f64,
    /// Source location.
    pub origin: Origin,
}

impl InjectedFault {
    /// Fault of a kind with the time window of its parameters.
    #[must_use]
    pub fn new(kind: FaultKind, origin: Origin) -> Self {
        let window = kind.window();
        let (from_s, until_s) = (window.from_s, window.until_s.unwrap_or(f64::INFINITY));
        Self { kind, from_s, until_s, origin }
    }

    /// Same fault with its time window counted from a simulated time \[s\].
    #[must_use]
    pub fn starting_at(self, time_s: f64) -> Self {
        Self { from_s: self.from_s + time_s, until_s: self.until_s + time_s, ..self }
    }

    /// Returns true if a simulated time \[s\] is in the window; its end is not.
    #[must_use]
    pub fn is_active_at(&self, time_s: f64) -> bool {
        self.from_s <= time_s && time_s < self.until_s
    }
}

/// Reads a list of faults, each `KIND: {PARAMETERS}`.
pub fn read_list(node: &YamlNode, diagnostics: &mut Diagnostics) -> Vec<InjectedFault> {
    let Some(items) = node.list() else {
        if !node.is_null() {
            let message = format!("`faults` is {}; it must be a list", node.kind());
            diagnostics.push(
                Diagnostic::error("bad-value", message)
                    .at(node.span)
                    .help("write `- dropout: {topic: /scan, probability: 0.3}`"),
            );
        }
        return Vec::new();
    };
    items.iter().filter_map(|item| read_fault(item, diagnostics)).collect()
}

/// Reads a fault `KIND: {PARAMETERS}`; `None` after an error.
pub fn read_fault(node: &YamlNode, diagnostics: &mut Diagnostics) -> Option<InjectedFault> {
    let names = || FaultKind::tables().iter().map(|table| table.name);
    let entry = match &node.value {
        YamlValue::Map(entries) if entries.len() == 1 => entries.first(),
        _ => None,
    };
    let Some((key, value)) = entry else {
        let message =
            format!("a fault is {}; it must be one kind with its parameters", node.kind());
        let example = "write `latency: {topic: /scan, mean: 0.2}`";
        diagnostics.push(Diagnostic::error("bad-fault", message).at(node.span).help(example));
        return None;
    };
    let word = key.text().unwrap_or_default();
    let table: Option<&'static Table> =
        FaultKind::tables().iter().copied().find(|table| table.name == word);
    let Some(table) = table else {
        let kinds: Vec<&str> = names().collect();
        diagnostics.push(
            Diagnostic::error("unknown-fault", format!("there is no fault `{word}`"))
                .at(key.span)
                .did_you_mean(key.span, word, names())
                .note(format!("faults: {}", kinds.join(", "))),
        );
        return None;
    };
    let before = diagnostics.errors();
    let values = read_section(table, value, diagnostics);
    let kind = FaultKind::from_values(&values)?;
    check(&kind, value, diagnostics);
    (diagnostics.errors() == before).then(|| InjectedFault::new(kind, key.span.into()))
}

/// Checks what the table cannot: lengths of lists, and pairs of numbers.
fn check(kind: &FaultKind, node: &YamlNode, diagnostics: &mut Diagnostics) {
    let mut complain = |name: &str, message: String| {
        let at = node.get(name).map_or(node.span, |value| value.span);
        diagnostics.push(Diagnostic::error("bad-value", message).at(at));
    };
    let mut pose = |pose: &[f64]| {
        if !matches!(pose.len(), 2 | 3) {
            let message = format!("`pose` has {} numbers; write [x, y] or [x, y, yaw]", pose.len());
            complain("pose", message);
        }
    };
    match kind {
        FaultKind::Kidnap(it) => pose(&it.pose),
        FaultKind::MovedModel(it) => pose(&it.pose),
        FaultKind::Box(it) => {
            pose(&it.pose);
            if it.size_m.len() != 3 {
                let message = format!("`size` has {} numbers; write [x, y, z]", it.size_m.len());
                complain("size", message);
            }
        }
        FaultKind::ClosedDoor(it) => {
            for (name, point) in [("left", &it.left_m), ("right", &it.right_m)] {
                if point.len() != 2 {
                    complain(name, format!("`{name}` has {} numbers; write [x, y]", point.len()));
                }
            }
        }
        FaultKind::BlockedSector(it) if it.min_angle_rad > it.max_angle_rad => {
            let (min, max) = (it.min_angle_rad, it.max_angle_rad);
            complain("max_angle", format!("the sector from {min} to {max} rad is empty"));
        }
        FaultKind::Noise(it) if it.period_s > 0.0 && it.length_s > it.period_s => {
            let message =
                format!("a burst of {} s does not fit into {} s", it.length_s, it.period_s);
            complain("length", message);
        }
        _ => {}
    }
    let window = kind.window();
    if window.until_s.is_some_and(|until_s| until_s <= window.from_s) {
        complain("until", "the fault ends before it starts".to_owned());
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use periplus_diagnostics::{RenderStyle, SourceMap, render};

    use super::*;

    fn check(text: &str, expected: Expect) -> Vec<InjectedFault> {
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("faults.yaml", text);
        let tree = periplus_yaml::parse(file, &sources).unwrap().unwrap();
        let faults = read_list(&tree, &mut diagnostics);
        let shown: String =
            diagnostics.iter().map(|one| render(one, &sources, RenderStyle::Plain)).collect();
        expected.assert_eq(&shown);
        faults
    }

    #[test]
    fn a_fault_has_its_window_and_parameters() {
        let faults = check("- dropout: {topic: /scan, from: 2, until: 3}", expect![[""]]);
        let [fault] = faults.as_slice() else { panic!("{faults:?}") };
        let active = [1.9, 2.0, 2.9, 3.0].map(|time_s| fault.is_active_at(time_s));
        assert_eq!(active, [false, true, true, false]);
        let later = fault.clone().starting_at(10.0);
        assert!(later.is_active_at(12.5) && !later.is_active_at(2.5));
    }

    #[test]
    fn mistakes_are_located() {
        let faults = check(
            "- dropuot: {topic: /scan}\n- latency: {topic: /scan, meen: 0.2}\n- kidnap: {pose: [1]}\n- bias: 3\n",
            expect![[r#"
                error[unknown-fault]: there is no fault `dropuot`
                 --> faults.yaml:1:3
                  |
                1 | - dropuot: {topic: /scan}
                  |   ^^^^^^^
                  |
                  = note: faults: dropout, packet_loss, latency, duplicate, reorder, clock_jump, bias, noise, stuck_readings, blocked_sector, gyro_drift, glass, mirror, wheel_slip, low_friction, stuck_wheel, kidnap, moved_model, box, closed_door
                help: did you mean `dropout`?
                  |
                1 - - dropuot: {topic: /scan}
                1 + - dropout: {topic: /scan}
                  |
                error[unknown-parameter]: latency has no parameter `meen`
                 --> faults.yaml:2:27
                  |
                2 | - latency: {topic: /scan, meen: 0.2}
                  |                           ^^^^ this is ignored
                  |
                help: did you mean `mean`?
                  |
                2 - - latency: {topic: /scan, meen: 0.2}
                2 + - latency: {topic: /scan, mean: 0.2}
                  |
                error[bad-value]: `pose` has 1 numbers; write [x, y] or [x, y, yaw]
                 --> faults.yaml:3:18
                  |
                3 | - kidnap: {pose: [1]}
                  |                  ^^^
            "#]],
        );
        assert_eq!(faults.len(), 1);
    }
}
