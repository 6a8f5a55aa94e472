//! Arguments of the spawners of ROS 1 and ROS 2.

/// Spawner, or its opposite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum SpawnerKind {
    /// Loads, configures and activates controllers.
    #[default]
    Spawner,
    /// Deactivates and unloads controllers.
    Unspawner,
}

/// Arguments of a spawner.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SpawnerOptions {
    pub(crate) kind: SpawnerKind,
    /// Controllers.
    pub(crate) names: Vec<String>,
    /// Controller manager, relative to the namespace of the spawner.
    pub(crate) manager: String,
    /// Class (`-t`).
    pub(crate) class: Option<String>,
    /// Parameter files (`-p`).
    pub(crate) parameter_files: Vec<String>,
    /// Arguments of the controllers' nodes (`--controller-ros-args`).
    pub(crate) ros_arguments: Vec<String>,
    pub(crate) loads_only: bool,
    /// Leaves the controllers configured (`--inactive`, `--stopped`).
    pub(crate) stays_inactive: bool,
    pub(crate) activates_as_group: bool,
    pub(crate) unloads_at_end: bool,
    /// Maximum time to wait for the manager; 0 for ever \[s\].
    pub(crate) manager_timeout_s: f64,
}

/// Options with a value that has no effect in a simulation.
const OTHER_VALUES: [&str; 7] = [
    "--switch-timeout",
    "--service-call-timeout",
    "--timeout",
    "--shutdown-timeout",
    "--wait-for",
    "--namespace-timeout",
    "-n",
];

impl SpawnerOptions {
    /// Reads the arguments. `path` resolves a path for the program.
    ///
    /// # Errors
    /// A message, when a value or the controllers are missing.
    pub(crate) fn read(
        kind: SpawnerKind,
        words: &[String],
        path: &dyn Fn(&str) -> String,
    ) -> Result<Self, String> {
        let mut options =
            Self { kind, manager: "controller_manager".to_owned(), ..Self::default() };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let (option, attached) = match word.split_once('=') {
                Some((option, value)) if option.starts_with("--") => (option, Some(value)),
                _ => (word.as_str(), None),
            };
            let mut value = || {
                let value = attached.map(str::to_owned).or_else(|| words.next().cloned());
                value.ok_or_else(|| format!("`{option}` needs a value"))
            };
            match option {
                "-c" | "--controller-manager" => options.manager = value()?,
                "-t" | "--controller-type" => options.class = Some(value()?),
                "-p" | "--param-file" => options.parameter_files.push(path(&value()?)),
                "--controller-ros-args" => {
                    let words = value()?;
                    options.ros_arguments.extend(words.split_whitespace().map(str::to_owned));
                }
                "--namespace" => {
                    let namespace = value()?;
                    options.manager =
                        format!("/{}/controller_manager", namespace.trim_matches('/'));
                }
                "--controller-manager-timeout" => {
                    let text = value()?;
                    options.manager_timeout_s = text
                        .parse()
                        .map_err(|_| format!("`{option} {text}` is not a number of seconds"))?;
                }
                "--load-only" => options.loads_only = true,
                "--inactive" | "--stopped" => options.stays_inactive = true,
                "--activate-as-group" => options.activates_as_group = true,
                "-u" | "--unload-on-kill" => options.unloads_at_end = true,
                "--switch-asap" | "--no-switch-asap" | "--no-timeout" => {}
                other if OTHER_VALUES.contains(&other) => drop(value()?),
                other if other.starts_with('-') => {
                    return Err(format!("the option `{other}` is not known"));
                }
                name => options.names.push(name.trim_start_matches('/').to_owned()),
            }
        }
        if options.names.is_empty() {
            return Err("no controllers are named".into());
        }
        Ok(options)
    }

    /// Reads `ros2 control load_controller [--set-state STATE] NAME [FILE]`.
    ///
    /// # Errors
    /// A message, when the controller is missing.
    pub(crate) fn of_command(
        words: &[String],
        path: &dyn Fn(&str) -> String,
    ) -> Result<Self, String> {
        let mut plain = Vec::new();
        let mut state = None;
        let mut spawner = Vec::new();
        let mut words = words.iter();
        while let Some(word) = words.next() {
            match word.as_str() {
                "--set-state" => state = words.next().cloned(),
                "-c" | "--controller-manager" => {
                    spawner.extend([word.clone(), words.next().cloned().unwrap_or_default()]);
                }
                option if option.starts_with('-') => {}
                _ => plain.push(word.clone()),
            }
        }
        match state.as_deref() {
            Some("active" | "start") => {}
            Some(_) => spawner.push("--inactive".to_owned()),
            None => spawner.push("--load-only".to_owned()),
        }
        let mut plain = plain.into_iter();
        spawner.extend(plain.next());
        for file in plain {
            spawner.extend(["-p".to_owned(), file]);
        }
        Self::read(SpawnerKind::Spawner, &spawner, path)
    }

    /// Full name of the controller manager for a spawner in a namespace.
    pub(crate) fn manager_of(&self, namespace: &str) -> String {
        if self.manager.starts_with('/') {
            return self.manager.clone();
        }
        format!("{}/{}", namespace.trim_end_matches('/'), self.manager)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    fn read(line: &str) -> Result<SpawnerOptions, String> {
        SpawnerOptions::read(SpawnerKind::Spawner, &words(line), &|path| format!("/ws/{path}"))
    }

    #[test]
    fn options_of_both_generations() {
        let told = read(
            "a -c /bot/controller_manager b --param-file c.yaml -p=d.yaml -t demo/Class \
             --controller-manager-timeout 7 --switch-timeout 2 --inactive",
        );
        // A short option has its value after a blank.
        assert_eq!(told.unwrap_err(), "the option `-p=d.yaml` is not known");
        let told = read(
            "a -c /bot/controller_manager b --param-file=c.yaml -p d.yaml -t demo/Class \
             --controller-manager-timeout 7 --switch-timeout 2 --inactive",
        )
        .unwrap();
        assert_eq!((told.names, told.stays_inactive), (words("a b"), true));
        assert_eq!(told.parameter_files, ["/ws/c.yaml", "/ws/d.yaml"]);
        assert_eq!((told.class.as_deref(), told.manager_timeout_s), (Some("demo/Class"), 7.0));
        let told = read("--namespace=/jackal --shutdown-timeout=1 /joints wheels").unwrap();
        assert_eq!(told.names, ["joints", "wheels"]);
        assert_eq!(told.manager_of("/"), "/jackal/controller_manager");
        assert_eq!(read("a").unwrap().manager_of("/bot"), "/bot/controller_manager");
        assert_eq!(read("--inactive").unwrap_err(), "no controllers are named");
    }

    #[test]
    fn the_command_of_ros2_control() {
        let told = SpawnerOptions::of_command(&words("--set-state active a"), &|p| p.to_owned());
        assert!(!told.unwrap().stays_inactive);
        let told = SpawnerOptions::of_command(&words("a b.yaml"), &|p| p.to_owned()).unwrap();
        assert!(told.loads_only && told.parameter_files == ["b.yaml"]);
    }
}
