//! Robot descriptions.

use periplus_xml::Element;

use super::LaunchWriter;

impl LaunchWriter<'_> {
    /// Expression of a robot description; `None` if the parameter has none.
    pub(super) fn description(&mut self, element: &Element) -> Option<String> {
        let command = if let Some(command) = element.value("command") {
            self.name_robot(command);
            // The program is on the PATH, and macros are in order since Melodic.
            let command = command.replace("--inorder", "");
            let mut command = command.split_whitespace().collect::<Vec<_>>().join(" ");
            for program in ["$(find xacro)/xacro.py", "$(find xacro)/xacro"] {
                if let Some(rest) = command.strip_prefix(program) {
                    command = format!("xacro{rest}");
                }
            }
            command
        } else if let Some(file) = element.value("textfile") {
            self.refer(file);
            format!("cat {file}")
        } else {
            let value = element.value("value")?;
            let text = self.text(value);
            return Some(self.string_value(&text));
        };
        let text = self.text(&command);
        let class = self.name("launch.substitutions", "Command");
        let text = format!("{class}({text})");
        Some(self.string_value(&text))
    }

    /// Parameter of type string, which is not read as YAML.
    fn string_value(&mut self, text: &str) -> String {
        let class = self.name("launch_ros.parameter_descriptions", "ParameterValue");
        format!("{class}({text}, value_type=str)")
    }

    /// The xacro or URDF file in a command.
    fn name_robot(&mut self, command: &str) {
        let command = self.with_defaults(command);
        // Substitutions contain blanks.
        let whole = command.replace("$(find ", "$(find\u{1}");
        for word in whole.split_whitespace() {
            let word = word.trim_matches(['\'', '"']).replace('\u{1}', " ");
            if [".xacro", ".urdf"].iter().any(|end| word.ends_with(end)) {
                self.refer(&word);
            }
        }
    }
}
