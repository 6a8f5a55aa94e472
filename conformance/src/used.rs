//! Record of the parts of a case that a check has used.

use std::cell::RefCell;
use std::collections::BTreeSet;

use serde_json::Value;

/// Members that are remarks wherever they are, if they are texts.
const REMARKS: [&str; 8] =
    ["note", "notes", "comment", "remark", "description", "evaluate", "fields", "units"];

/// The values of a case that a check has read or compared, by where they are in memory. A value that is
/// not among them at the end has had no influence on the verdict.
#[derive(Debug, Default)]
pub struct Used(RefCell<BTreeSet<usize>>);

impl Used {
    /// Notes one value.
    pub(crate) fn mark(&self, value: &Value) {
        self.0.borrow_mut().insert(address(value));
    }

    /// Notes a value and all within it.
    pub(crate) fn mark_all(&self, value: &Value) {
        self.mark(value);
        match value {
            Value::Array(list) => list.iter().for_each(|it| self.mark_all(it)),
            Value::Object(members) => members.values().for_each(|it| self.mark_all(it)),
            _ => {}
        }
    }

    /// The paths of what has not been used, each as short as it can be.
    pub(crate) fn unused(&self, value: &Value, path: &str) -> Vec<String> {
        let mut unused = Vec::new();
        if !self.collect(value, path, &mut unused) && !self.has(value) {
            return vec![path.to_owned()];
        }
        unused
    }

    fn has(&self, value: &Value) -> bool {
        self.0.borrow().contains(&address(value))
    }

    /// Adds the paths of what has not been used; true if anything has been.
    fn collect(&self, value: &Value, path: &str, unused: &mut Vec<String>) -> bool {
        let parts: Vec<(String, &Value)> = match value {
            Value::Array(list) => {
                list.iter().enumerate().map(|(at, it)| (format!("{path}[{at}]"), it)).collect()
            }
            Value::Object(members) => members
                .iter()
                .filter(|(name, it)| !is_remark(name, it))
                .map(|(name, it)| (format!("{path}.{name}"), it))
                .collect(),
            _ => Vec::new(),
        };
        if parts.is_empty() {
            let is_used = self.has(value);
            if !is_used {
                unused.push(path.to_owned());
            }
            return is_used;
        }
        let mut within = Vec::new();
        let mut is_used = false;
        for (path, part) in &parts {
            is_used |= self.collect(part, path, &mut within);
        }
        if is_used {
            unused.append(&mut within);
        } else {
            unused.push(path.to_owned());
        }
        is_used
    }
}

/// True for a text that only explains the case.
pub(crate) fn is_remark(name: &str, value: &Value) -> bool {
    value.is_string() && REMARKS.contains(&name)
}

fn address(value: &Value) -> usize {
    std::ptr::from_ref(value).addr()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_was_not_read_is_named_by_the_shortest_path() {
        let value =
            json!({"a": 1, "b": [2, {"c": 3, "d": 4}], "e": {"f": [5]}, "g": [], "note": "x"});
        let used = Used::default();
        assert_eq!(used.unused(&value, "case"), ["case"]);
        used.mark(&value["a"]);
        used.mark(&value["b"][1]["c"]);
        let expected = ["case.b[0]", "case.b[1].d", "case.e", "case.g"];
        assert_eq!(used.unused(&value, "case"), expected);
        used.mark_all(&value);
        assert_eq!(used.unused(&value, "case"), [""; 0]);
    }
}
