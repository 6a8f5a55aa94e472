//! Dependency rules between the wings of the workspace.
//!
//! A crate belongs to the wing that contains its folder: `crates/<wing>/<room>`. A crate uses
//! other crates of its wing and of wings below it; wings in one row do not use each other. The facade,
//! `crates/periplus`, is alone in its wing, beside the apps: it re-exports libraries. Estimators
//! never reach the files of robots or the simulation, not even through other crates: an estimator
//! that can read the truth proves nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use serde_json::Value;

use crate::step::{Failed, metadata};

/// Wings in their rows, the lowest row first.
const ROWS: [&[&str]; 7] = [
    &["foundation"],
    &["messages"],
    &["robot-files", "estimation"],
    &["navigation"],
    &["middleware"],
    &["simulation", "nav-nodes", "transports"],
    &["apps", FACADE],
];

/// Wing and room of the crate that re-exports the libraries.
const FACADE: &str = "periplus";

/// Wings that must not reach other wings through any chain of crates, and the reason.
const NEVERS: [(&[&str], &[&str], &str); 3] = [
    (
        &["estimation", "navigation", "nav-nodes"],
        &["robot-files", "simulation"],
        "an estimator or navigator gets messages only, never the truth",
    ),
    (&["middleware", "transports"], &["simulation"], "a network does not know the simulator"),
    (&["foundation"], &["messages"], "the foundation serves programs without ROS"),
];

/// Single uses that break a rule of the rows, each with its reason. ARCHITECTURE.md lists them too.
const EXCEPTIONS: [(&str, &str, &str); 4] = [
    ("periplus-loader", "periplus-grid", "the walls of a map become a world"),
    ("periplus-loader", "periplus-maps", "a map file is one of the files that are recognised"),
    ("periplus-cli", "periplus-conformance", "`periplus conformance` runs the case files"),
    ("periplus-python", "periplus", "the Python package offers the same libraries"),
];

pub(crate) fn run() -> Result<(), Failed> {
    let metadata = metadata()?;
    let crates = crates(&metadata);
    print!("{}", table(&crates));
    let mut faults = faults(&crates, &EXCEPTIONS);
    faults.extend(stale(&crates, &EXCEPTIONS));
    if faults.is_empty() { Ok(()) } else { Err(Failed(faults.join("\n       "))) }
}

/// A crate of the workspace.
#[derive(Debug)]
struct Crate {
    /// None for crates beside the product (`conformance`, `xtask`, `benches`), which may use
    /// everything.
    wing: Option<String>,
    /// The last part of its folder.
    room: String,
    /// Crates of the workspace that it is built with.
    uses: BTreeSet<String>,
}

impl Crate {
    fn row(&self) -> Option<usize> {
        let wing = self.wing.as_deref()?;
        ROWS.iter().position(|row| row.contains(&wing))
    }
}

fn crates(metadata: &Value) -> BTreeMap<String, Crate> {
    let packages = metadata["packages"].as_array().map(Vec::as_slice).unwrap_or_default();
    let name = |value: &Value| value["name"].as_str().unwrap_or_default().to_owned();
    let names: BTreeSet<String> = packages.iter().map(name).collect();
    let read = |package: &Value| {
        let dependencies = package["dependencies"].as_array();
        // A dependency of the tests alone does not make a crate depend on it.
        let uses = dependencies
            .into_iter()
            .flatten()
            .filter(|dependency| dependency["kind"] != "dev")
            .map(name)
            .filter(|dependency| names.contains(dependency))
            .collect();
        let (wing, room) = folder(package["manifest_path"].as_str().unwrap_or_default());
        Crate { wing, room, uses }
    };
    packages.iter().map(|package| (name(package), read(package))).collect()
}

/// The wing and the room of a manifest; below `crates` the folder above the room is the wing.
fn folder(manifest: &str) -> (Option<String>, String) {
    let mut parts = manifest.rsplit(['/', '\\']).skip(1);
    let room = parts.next().unwrap_or_default().to_owned();
    let wing = parts.next().unwrap_or_default();
    if wing == "crates" && room == FACADE {
        return (Some(FACADE.to_owned()), room);
    }
    let is_product = wing == "crates" || parts.next() == Some("crates");
    (is_product.then(|| wing.to_owned()), room)
}

fn faults(crates: &BTreeMap<String, Crate>, exceptions: &[(&str, &str, &str)]) -> Vec<String> {
    let mut faults = Vec::new();
    for (name, this) in crates {
        if let Some(wing) = &this.wing {
            if this.row().is_none() {
                let wings = ROWS.concat().join(", ");
                faults.push(format!(
                    "{name}: `{wing}` is not a wing: move it to crates/<wing>/{}, one of {wings}",
                    this.room
                ));
            }
            if wing != FACADE && *name != format!("periplus-{}", this.room) {
                faults.push(format!("{name}: rename it to periplus-{}, as its folder", this.room));
            }
        }
        for used in &this.uses {
            let is_excepted = exceptions.iter().any(|(from, to, _)| from == name && to == used);
            if !is_excepted {
                faults.extend(fault_of_use((name, this), (used, &crates[used])));
            }
        }
        faults.extend(nevers(crates, name, this));
    }
    faults
}

/// Returns the broken rule of rows, if one crate may not use the other.
fn fault_of_use((name, this): (&str, &Crate), (used, other): (&str, &Crate)) -> Option<String> {
    let own = this.wing.as_ref()?;
    let Some(wing) = &other.wing else {
        return Some(format!("{name} uses {used}, which is not part of the product"));
    };
    if own == wing || this.row()? > other.row()? {
        return None;
    }
    Some(format!("{name} ({own}) uses {used} ({wing}): only wings of lower rows may be used"))
}

/// Chains of uses from a crate into wings that it must never reach.
fn nevers(crates: &BTreeMap<String, Crate>, name: &str, this: &Crate) -> Vec<String> {
    let wing = this.wing.as_deref().unwrap_or_default();
    let mut faults = Vec::new();
    for (_, never, why) in NEVERS.iter().filter(|(from, _, _)| from.contains(&wing)) {
        let is_never = |one: &Crate| one.wing.as_deref().is_some_and(|wing| never.contains(&wing));
        if let Some(chain) = chain(crates, name, is_never) {
            let last = chain.last().and_then(|last| crates[last].wing.clone()).unwrap_or_default();
            let chain = chain.join(" uses ");
            faults.push(format!("{wing} reaches {last}: {chain}; {why}"));
        }
    }
    faults
}

/// A chain of uses from one crate to the first that matches.
fn chain(
    crates: &BTreeMap<String, Crate>,
    from: &str,
    is_wanted: impl Fn(&Crate) -> bool,
) -> Option<Vec<String>> {
    let mut reached = BTreeSet::from([from.to_owned()]);
    let mut chains = vec![vec![from.to_owned()]];
    while let Some(chain) = chains.pop() {
        let last = chain.last()?;
        if is_wanted(&crates[last]) {
            return Some(chain);
        }
        for next in &crates[last].uses {
            if reached.insert(next.clone()) {
                chains.push(chain.iter().chain([next]).cloned().collect());
            }
        }
    }
    None
}

/// Exceptions that no crate needs.
fn stale(crates: &BTreeMap<String, Crate>, exceptions: &[(&str, &str, &str)]) -> Vec<String> {
    let is_used = |from: &str, to: &str| crates.get(from).is_some_and(|one| one.uses.contains(to));
    let stale = exceptions.iter().filter(|(from, to, _)| !is_used(from, to));
    let fault = |(from, to, _): &(&str, &str, &str)| {
        format!("{from} no longer uses {to}: remove this exception")
    };
    stale.map(fault).collect()
}

/// The crates by wing, the highest row first.
fn table(crates: &BTreeMap<String, Crate>) -> String {
    let mut table = String::new();
    let wings = ROWS.iter().rev().flat_map(|row| row.iter()).map(|wing| Some(*wing));
    for wing in [None].into_iter().chain(wings) {
        let _ = writeln!(table, "{}", wing.unwrap_or("beside the product"));
        for (name, this) in crates.iter().filter(|(_, this)| this.wing.as_deref() == wing) {
            let uses: Vec<&str> = this.uses.iter().map(|used| short(used)).collect();
            let line = format!("  {:<14} {}", short(name), uses.join(" "));
            let _ = writeln!(table, "{}", line.trim_end());
        }
    }
    table
}

fn short(name: &str) -> &str {
    name.strip_prefix("periplus-").unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// A crate's folder below the root, and the crates that it uses with the kind of use.
    type MadeUp<'a> = (&'a str, &'a [(&'a str, Option<&'a str>)]);

    fn name_of(folder: &str) -> String {
        let room = folder.rsplit('/').next().unwrap_or(folder);
        if folder.starts_with("crates/") { format!("periplus-{room}") } else { room.to_owned() }
    }

    /// The answer of `cargo metadata` for such crates.
    fn workspace(made_up: &[MadeUp]) -> Value {
        let packages: Vec<Value> = made_up
            .iter()
            .map(|(folder, uses)| {
                let uses: Vec<Value> =
                    uses.iter().map(|(name, kind)| json!({"name": name, "kind": kind})).collect();
                json!({
                    "name": name_of(folder),
                    "manifest_path": format!("/x/{folder}/Cargo.toml"),
                    "dependencies": uses,
                })
            })
            .collect();
        json!({ "packages": packages })
    }

    #[track_caller]
    fn check(made_up: &[MadeUp], expected: &[&str]) {
        assert_eq!(faults(&crates(&workspace(made_up)), &[]), expected);
    }

    #[test]
    fn a_workspace_in_order() {
        let house: &[MadeUp] = &[
            ("crates/foundation/geometry", &[("serde", None), ("periplus-cli", Some("dev"))]),
            ("crates/apps/launch", &[("periplus-geometry", None)]),
            ("crates/apps/cli", &[("periplus-geometry", None), ("periplus-launch", None)]),
            ("xtask", &[("periplus-cli", None)]),
        ];
        check(house, &[]);
        let expected = "beside the product\n  xtask          cli\napps\n  \
            cli            geometry launch\n  launch         geometry\nperiplus\nsimulation\nnav-nodes\n\
            transports\nmiddleware\nnavigation\nrobot-files\nestimation\nmessages\nfoundation\n  geometry\n";
        assert_eq!(table(&crates(&workspace(house))), expected);
    }

    #[test]
    fn only_lower_rows_are_used() {
        let rules = [
            ("messages", "foundation", true),
            ("foundation", "middleware", false),
            ("middleware", "estimation", true),
            ("robot-files", "estimation", false),
            ("transports", "nav-nodes", false),
            ("simulation", "simulation", true),
        ];
        for (own, wing, is_fine) in rules {
            for kind in [None, Some("build")] {
                let uses = [("periplus-b", kind)];
                let (a, b) = (format!("crates/{own}/a"), format!("crates/{wing}/b"));
                let fault = format!(
                    "periplus-a ({own}) uses periplus-b ({wing}): \
                     only wings of lower rows may be used"
                );
                let expected: &[&str] = if is_fine { &[] } else { &[fault.as_str()] };
                check(&[(&a, &uses), (&b, &[])], expected);
            }
        }
    }

    #[test]
    fn every_crate_has_a_wing_and_its_folders_name() {
        let wings = ROWS.concat().join(", ");
        check(
            &[("crates/a", &[]), ("crates/attic/b", &[("xtask", None)]), ("xtask", &[])],
            &[
                &format!(
                    "periplus-a: `crates` is not a wing: move it to crates/<wing>/a, one of {wings}"
                ),
                &format!(
                    "periplus-b: `attic` is not a wing: move it to crates/<wing>/b, one of {wings}"
                ),
                "periplus-b uses xtask, which is not part of the product",
            ],
        );
        let mut workspace = workspace(&[("crates/estimation/slam", &[])]);
        workspace["packages"][0]["name"] = json!("periplus-mapper");
        assert_eq!(
            faults(&crates(&workspace), &[]),
            ["periplus-mapper: rename it to periplus-slam, as its folder"]
        );
        let facade = folder("/x/crates/periplus/Cargo.toml");
        assert_eq!(facade, (Some(FACADE.to_owned()), FACADE.to_owned()));
        let windows = folder(r"C:\x\crates\apps\cli\Cargo.toml");
        assert_eq!(windows, (Some("apps".to_owned()), "cli".to_owned()));
    }

    #[test]
    fn estimators_never_reach_the_truth() {
        // The use in the middle is excepted, so that only the chain is a fault.
        let exceptions = [("periplus-maps", "periplus-scene", "a reason")];
        let house: &[MadeUp] = &[
            ("crates/nav-nodes/nav-nodes", &[("periplus-maps", None)]),
            ("crates/estimation/maps", &[("periplus-scene", None)]),
            ("crates/robot-files/scene", &[]),
            ("crates/simulation/sensors", &[("periplus-scene", None)]),
        ];
        assert_eq!(
            faults(&crates(&workspace(house)), &exceptions),
            [
                "estimation reaches robot-files: periplus-maps uses periplus-scene; \
                 an estimator or navigator gets messages only, never the truth",
                "nav-nodes reaches robot-files: periplus-nav-nodes uses periplus-maps uses \
                 periplus-scene; an estimator or navigator gets messages only, never the truth",
            ]
        );
    }

    #[test]
    fn exceptions_are_needed() {
        let exceptions = [("periplus-loader", "periplus-maps", "a reason")];
        let loader = |uses| crates(&workspace(&[("crates/robot-files/loader", uses), MAPS]));
        const MAPS: MadeUp = ("crates/estimation/maps", &[]);
        let used = loader(&[("periplus-maps", None)]);
        assert_eq!(faults(&used, &exceptions), Vec::<String>::new());
        assert_eq!(faults(&used, &[]).len(), 1);
        assert_eq!(stale(&used, &exceptions), Vec::<String>::new());
        assert_eq!(
            stale(&loader(&[]), &exceptions),
            ["periplus-loader no longer uses periplus-maps: remove this exception"]
        );
    }
}
