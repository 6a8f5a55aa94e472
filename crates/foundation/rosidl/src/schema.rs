//! Schema texts for MCAP's `ros2msg` and Foxglove.

use crate::{Registry, TypeName};

/// Line between the types of a schema: 80 times `=`.
pub const SEPARATOR: &str =
    "================================================================================";

impl Registry {
    /// Text of a type, followed by the texts of all types that it refers to, each after a line of `=` and a
    /// line with its name, breadth first. `None` if the type is unknown or implied.
    ///
    /// Format: MCAP specification's registry, "ros2msg".
    #[must_use]
    pub fn schema_text(&self, name: &TypeName) -> Option<String> {
        let mut schema = self.get(name)?.text.trim_end().to_owned();
        schema.push('\n');
        let mut order = vec![name];
        let mut next = 0;
        while let Some(definition) = order.get(next).and_then(|name| self.get(name)) {
            for (_, nested) in definition.nested() {
                if !order.contains(&nested) {
                    order.push(nested);
                }
            }
            next += 1;
        }
        for name in &order[1..] {
            let text = self.get(name)?.text.trim_end();
            schema.push_str(&format!("{SEPARATOR}\nMSG: {}\n{text}\n", name.short()));
        }
        Some(schema)
    }
}
