//! Graphviz text with the labels of `view_frames`.
//!
//! Format: `tf2_tools/view_frames.py`. Additions: static frames are dashed, isolated frames are
//! included, additional parents are red.

use std::fmt::Write as _;

use periplus_tf::TransformKind;

use crate::frames::forest::Forest;

impl Forest {
    /// Graphviz text of the tree, with the time of recording \[s\].
    #[must_use]
    pub fn dot(&self, recorded_at: &str) -> String {
        if self.frames.is_empty() {
            return "digraph G { \"No tf data received\" }".into();
        }
        let mut text = String::from("digraph G {\n");
        for frame in self.frames() {
            let child = quoted(&frame.name);
            let Some(edge) = &frame.edge else {
                // Writing to a String cannot fail.
                let _ = writeln!(text, "{child};");
                continue;
            };
            let lines: String =
                edge.label().iter().map(|line| format!("{}\\n", escaped(line))).collect();
            let style = if edge.kind == TransformKind::Fixed { ", style=dashed" } else { "" };
            let _ =
                writeln!(text, "{} -> {child}[label=\" {lines}\"{style}];", quoted(&edge.parent));
            for parent in &frame.other_parents {
                let _ = writeln!(text, "{} -> {child}[color=red, style=dotted];", quoted(parent));
            }
        }
        text += "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; \
                 label =\"view_frames Result\";\n";
        let _ = writeln!(
            text,
            "\"Recorded at time: {}\"[ shape=plaintext ] ;\n }}",
            escaped(recorded_at)
        );
        for &top in &self.tops {
            let top = quoted(&self.frames[top].name);
            let _ = writeln!(text, "\"Recorded at time: {}\"->{top};", escaped(recorded_at));
        }
        text.push_str("}\n");
        text
    }
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", escaped(name))
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', " ")
}
