//! Runs every example; each ends with its own check.

/// One test for each example, and the list of them.
macro_rules! examples {
    ($($name:ident: $file:literal,)*) => {
        $(
            #[path = $file]
            mod $name;
        )*

        /// Files that are run.
        const FILES: &[&str] = &[$($file),*];

        mod run {
            $(
                #[test]
                fn $name() -> Result<(), Box<dyn std::error::Error>> {
                    super::$name::main()
                }
            )*
        }
    };
}

examples! {
    simulate: "../examples/01_simulate.rs",
    raycast: "../examples/02_raycast.rs",
    build_map: "../examples/03_build_map.rs",
    localize: "../examples/04_localize.rs",
    costmap: "../examples/05_costmap.rs",
    tf: "../examples/06_tf.rs",
    bags: "../examples/07_bags.rs",
    node: "../examples/08_node.rs",
    own_planner: "../examples/09_own_planner.rs",
}

#[test]
#[allow(clippy::disallowed_methods, reason = "it lists the folder of the examples")]
fn every_example_is_run_and_listed() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let readme = include_str!("../README.md");
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("the folder of the examples") {
        let name = entry.expect("an entry").file_name().to_string_lossy().into_owned();
        if let Some(stem) = name.strip_suffix(".rs") {
            assert!(readme.contains(&format!("| `{stem}` |")), "{stem} is missing in README.md");
            found.push(format!("../examples/{name}"));
        }
    }
    found.sort();
    assert_eq!(found, FILES, "examples in the folder, and those in this file");
}
