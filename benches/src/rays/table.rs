//! Results of the race as a table.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde_json::Value;

/// Engine, scene, rays and number of threads.
type Key = (String, String, String, u64);

/// Tables in Markdown: rays per CPU second and how they compare, threads, builds, updates.
pub(super) fn tables(lines: &[Value]) -> String {
    let all = best(lines, "mrays_cpu", 1.0);
    let cpu: BTreeMap<&Key, f64> =
        all.iter().filter(|(key, _)| key.3 == 1).map(|(key, &rate)| (key, rate)).collect();
    let mut out = String::from(
        "Millions of rays per CPU second, one thread; of each peer, how many times as fast we are.\n\n",
    );
    let peers: Vec<String> = {
        let mut peers: Vec<String> = cpu.keys().map(|key| key.0.clone()).collect();
        peers.sort();
        peers.dedup();
        peers.retain(|peer| !peer.starts_with("ours"));
        peers
    };
    let _ = writeln!(out, "| scene | load | ours | {} |", peers.join(" | "));
    let _ = writeln!(out, "|---|---|---|{}", "---|".repeat(peers.len()));
    for (key, rate) in cpu.iter().filter(|(key, _)| key.0.starts_with("ours")) {
        let (who, scene, load, _) = key;
        let shapes = who == "ours-prim";
        let name = if shapes { format!("{scene}, shapes") } else { scene.clone() };
        let _ = write!(out, "| {name} | {load} | {rate:.1} |");
        for peer in &peers {
            // Shapes against shapes; triangles against triangles.
            let other = all.get(&(peer.clone(), scene.clone(), load.clone(), 1));
            match other {
                Some(other)
                    if peer.ends_with("-prim") == shapes || shapes && peer == "py:embreex" =>
                {
                    let _ = write!(out, " {:.2}x ({other:.2}) |", rate / other);
                }
                _ => out.push_str(" |"),
            }
        }
        out.push('\n');
    }
    out.push_str(&embree(lines, &all));
    out.push_str(
        "\nTwo threads against one, for each scene the worst and the best load: rays per second of \
         the clock (of use only on an idle machine), and per CPU second (what splitting costs).\n\n\
         | scene | clock | CPU |\n|---|---|---|\n",
    );
    let wall = best(lines, "mrays_best", 1.0);
    for (scene, clock) in two_to_one(&wall) {
        let cpu = two_to_one(&all).remove(&scene).unwrap_or((f64::NAN, f64::NAN));
        let _ = writeln!(
            out,
            "| {scene} | {:.2} to {:.2} | {:.2} to {:.2} |",
            clock.0, clock.1, cpu.0, cpu.1
        );
    }
    out.push_str("\nBuild, least \\[ms\\]:");
    let mut builds: BTreeMap<(String, String, u64), f64> = BTreeMap::new();
    for (key, ms) in best(lines, "build_ms", -1.0) {
        let own = builds.entry((key.1, key.0, key.3)).or_insert(f64::INFINITY);
        *own = own.min(ms);
    }
    for ((scene, peer, threads), ms) in builds {
        let _ = write!(out, " {scene} {peer} with {threads}: {ms:.1};");
    }
    let updates = lines.iter().filter_map(|line| line["update_us"].as_f64());
    let _ = write!(
        out,
        "\n\n112 moving instances: {:.1} us for a frame's update.\n",
        updates.fold(f64::INFINITY, f64::min)
    );
    out
}

/// Embree's C interface: the best of its packet widths, and the rays on which it and we differ.
fn embree(lines: &[Value], all: &BTreeMap<Key, f64>) -> String {
    let own: Vec<&Value> = lines.iter().filter(|line| line["peer"] == "c:embree").collect();
    let Some(version) = own.iter().find_map(|line| line["version"].as_str()) else {
        return String::new();
    };
    let mut out = format!(
        "\nEmbree {version} through its C interface, best packet width (1, 4, 8, 16; coherent or not), build \
         quality high, and rays whose distances differ from ours by more than 1 mm.\n\n\
         | scene | load | ours | Embree | ratio | width | flag | differ |\n|---|---|---|---|---|---|---|---|\n"
    );
    let mut best: BTreeMap<(&str, &str), &Value> = BTreeMap::new();
    for line in own {
        let (Some(scene), Some(load)) = (line["scene"].as_str(), line["load"].as_str()) else {
            continue;
        };
        let rate = |line: &Value| line["mrays_cpu"].as_f64().unwrap_or_default();
        let kept = best.entry((scene, load)).or_insert(line);
        if rate(line) > rate(kept) {
            *kept = line;
        }
    }
    for ((scene, load), line) in best {
        let key = ("ours".to_owned(), scene.to_owned(), load.to_owned(), 1);
        let (Some(ours), Some(rate)) = (all.get(&key), line["mrays_cpu"].as_f64()) else {
            continue;
        };
        let flag = if line["coherent"] == true { "coherent" } else { "incoherent" };
        let differ = lines
            .iter()
            .filter(|line| line["scene"] == scene && line["load"] == load)
            .find_map(|line| line["differ"].as_u64());
        let differ = differ.map_or_else(String::new, |count| count.to_string());
        let _ = writeln!(
            out,
            "| {scene} | {load} | {ours:.1} | {rate:.1} | {:.2} | {} | {flag} | {differ} |",
            ours / rate,
            line["width"]
        );
    }
    out
}

/// Our rate with two threads by that with one, least and greatest of a scene's loads that are large
/// enough to split.
fn two_to_one(rates: &BTreeMap<Key, f64>) -> BTreeMap<String, (f64, f64)> {
    let mut scenes = BTreeMap::new();
    for (key, two) in rates.iter().filter(|(key, _)| key.0 == "ours" && key.3 == 2) {
        let (_, scene, load, _) = key;
        let one = rates.get(&(key.0.clone(), scene.clone(), load.clone(), 1));
        let Some(one) = one.filter(|_| !load.starts_with("lidar2d")) else { continue };
        let (low, high) = scenes.entry(scene.clone()).or_insert((f64::INFINITY, 0.0));
        (*low, *high) = (f64::min(*low, two / one), f64::max(*high, two / one));
    }
    scenes
}

/// Largest value of each key, or with a `sign` of -1 the smallest.
fn best(lines: &[Value], name: &str, sign: f64) -> BTreeMap<Key, f64> {
    let mut all: BTreeMap<Key, f64> = BTreeMap::new();
    for line in lines {
        let text = |name: &str| line[name].as_str().map(str::to_owned);
        let (Some(peer), Some(scene), Some(load)) = (text("peer"), text("scene"), text("load"))
        else {
            continue;
        };
        let (Some(threads), Some(value)) = (line["threads"].as_u64(), line[name].as_f64()) else {
            continue;
        };
        let own = all.entry((peer, scene, load, threads)).or_insert(value);
        *own = if sign * value > sign * *own { value } else { *own };
    }
    all
}
