//! The software bill of materials of a program: CycloneDX 1.5 (<https://cyclonedx.org/docs/1.5/json/>).

use std::path::Path;

use serde_json::{Value, json};

use super::build::source_date;
use super::checksums;
use super::packages::{self, Package};
use super::target::Target;
use crate::step::{Failed, root};

/// Returns the bill of the program for a target, as JSON.
pub(super) fn of(source: &Path, target: &Target) -> Result<String, Failed> {
    let packages = packages::of(source, "periplus-cli", target)?;
    let bill = bill(&packages, target.triple, source_date(&root())?);
    serde_json::to_string_pretty(&bill)
        .map(|text| text + "\n")
        .map_err(|error| Failed(format!("SBOM: {error}")))
}

fn bill(packages: &[Package], triple: &str, time_s: u64) -> Value {
    let reference = |package: &Package| format!("{}@{}", package.name, package.version);
    let by_id = |id: &String| packages.iter().find(|it| it.id == *id).map(reference);
    let root = packages.iter().find(|it| it.name == "periplus-cli");
    let components = packages.iter().filter(|it| it.name != "periplus-cli");
    let components: Vec<Value> = components.map(|it| component(it, &reference(it))).collect();
    let dependencies = packages.iter().map(|package| {
        let needed: Vec<String> = package.dependencies.iter().filter_map(by_id).collect();
        json!({ "ref": reference(package), "dependsOn": needed })
    });
    let dependencies: Vec<Value> = dependencies.collect();
    let version = super::version();
    json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "serialNumber": serial_number(&format!("{components:?}{triple}{time_s}")),
        "version": 1,
        "metadata": {
            "timestamp": timestamp(time_s),
            "component": {
                "type": "application",
                "bom-ref": root.map(reference),
                "name": "periplus",
                "version": version,
                "licenses": [{ "license": { "id": "Apache-2.0" } }],
                "properties": [{ "name": "periplus:target", "value": triple }],
            },
        },
        "components": components,
        "dependencies": dependencies,
    })
}

fn component(package: &Package, reference: &str) -> Value {
    let mut component = json!({
        "type": "library",
        "bom-ref": reference,
        "name": package.name,
        "version": package.version,
        "licenses": [{ "expression": package.license }],
    });
    if !package.description.is_empty() {
        component["description"] = package.description.trim().into();
    }
    if package.is_foreign {
        // Build metadata (`+zstd.1.5.7`) is escaped in a package URL.
        let version = package.version.replace('+', "%2B");
        component["purl"] = format!("pkg:cargo/{}@{version}", package.name).into();
        if package.repository.starts_with("http") {
            component["externalReferences"] = json!([{ "type": "vcs", "url": package.repository }]);
        }
    }
    component
}

/// UUID of a hash of the content, in the form of version 8 (RFC 9562).
fn serial_number(content: &str) -> String {
    let digits = checksums::of(content.as_bytes());
    let part = |from: usize, to: usize| digits.get(from..to).unwrap_or_default();
    format!(
        "urn:uuid:{}-{}-8{}-a{}-{}",
        part(0, 8),
        part(8, 12),
        part(12, 15),
        part(15, 18),
        part(18, 30)
    )
}

fn timestamp(time_s: u64) -> String {
    let time = super::archive::utc(time_s);
    format!(
        "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z",
        time.year, time.month, time.day, time.hour, time.minute, time.second
    )
}

#[test]
fn a_bill_names_components_and_what_they_need() {
    let package = |name: &str, is_foreign: bool, dependencies: &[&str]| Package {
        id: name.to_owned(),
        name: name.to_owned(),
        version: "1.0.0+c".to_owned(),
        license: "MIT".to_owned(),
        authors: Vec::new(),
        repository: String::new(),
        description: String::new(),
        folder: std::path::PathBuf::new(),
        is_foreign,
        dependencies: dependencies.iter().map(|it| (*it).to_owned()).collect(),
    };
    let packages = [package("periplus-cli", false, &["lib"]), package("lib", true, &[])];
    let bill = bill(&packages, "t", 951_782_400);
    assert_eq!(bill["metadata"]["timestamp"], "2000-02-29T00:00:00Z");
    assert_eq!(bill["components"][0]["purl"], "pkg:cargo/lib@1.0.0%2Bc");
    assert_eq!(bill["dependencies"][0]["dependsOn"][0], "lib@1.0.0+c");
    assert_eq!(bill["components"].as_array().unwrap().len(), 1);
}
