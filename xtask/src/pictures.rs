//! Pictures for the documents: the terminal, from what the program really prints, the worlds, as
//! cameras see them, and costmaps, as RViz shows them.

use anstyle_svg::Term;

use crate::step::{Failed, cargo, root, run};

/// Each picture, and the words after `periplus` that it shows.
const PICTURES: &[(&str, &[&str])] = &[(
    "check",
    &["check", "misspelt_property.urdf.xacro", "remap_in_ros_element.urdf", "silent_lidar.sdf"],
)];

/// Each photo: its name, the world, where the camera stands, and what it looks at.
const PHOTOS: &[(&str, &str, &str, &str)] =
    &[("house", "worlds/house.sdf", "-5.6,1.6,2.0", "-3.13,2.95,0.97")];

/// Draws all pictures into `docs/pictures`.
///
/// # Errors
/// When the program cannot be run or a picture not be written.
pub(crate) fn draw() -> Result<(), Failed> {
    for (name, words) in PICTURES {
        let output = cargo()
            .args(["run", "--quiet", "--manifest-path"])
            .arg(root().join("Cargo.toml"))
            .args(["--package", "periplus-cli", "--", "--color", "always"])
            .args(*words)
            .current_dir(root().join("crates/robot-files/loader/tests/broken"))
            .output()
            .map_err(|error| Failed(format!("cannot run periplus: {error}")))?;
        let printed = String::from_utf8_lossy(&output.stdout);
        let shown =
            format!("\u{1b}[1m$ periplus {}\u{1b}[0m\n\n{}", words.join(" "), printed.trim_end());
        let picture = Term::new().render_svg(&shown);
        let path = root().join("docs/pictures").join(format!("{name}.svg"));
        std::fs::write(&path, picture)
            .map_err(|error| Failed(format!("cannot write {}: {error}", path.display())))?;
        println!("{}", path.display());
    }
    for (name, world, from, to) in PHOTOS {
        let path = format!("docs/pictures/{name}.png");
        let mut look = cargo();
        look.args([
            "run",
            "--quiet",
            "--release",
            "--package",
            "periplus-cli",
            "--",
            "look",
            *world,
        ]);
        look.args([format!("--from={from}"), format!("--to={to}"), format!("--output={path}")]);
        run(look.current_dir(root()), "see above")?;
    }
    let path = "docs/pictures/costmaps.png";
    run(example("costmap_picture").arg(path), "see above")?;
    println!("{path}");
    Ok(())
}

/// A small program of the simulator, to be given its words.
fn example(name: &str) -> std::process::Command {
    let mut program = cargo();
    program.args(["run", "--quiet", "--release", "--package", "periplus-sim"]);
    program.args(["--example", name, "--"]);
    program
}
