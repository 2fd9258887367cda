//! The seeds of the fuzz targets, read as fuzzing reads them, so that a bug found once stays found.

#[path = "../../tests/fuzz/src/lib.rs"]
#[expect(unreachable_pub, reason = "public for the fuzz targets")]
mod fuzz;

use std::path::Path;

type Check = fn(&[u8]);

#[test]
fn every_seed_holds() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fuzz/seeds");
    let targets: [(&str, Check); 4] =
        [("domain", fuzz::domain), ("problem", fuzz::problem), ("hddl", fuzz::hddl), ("plan", fuzz::plan)];
    for (folder, check) in targets {
        let files = std::fs::read_dir(seeds.join(folder)).expect("each target has seeds");
        for file in files {
            let path = file.expect("the folder can be read").path();
            println!("{}", path.display());
            check(&std::fs::read(path).expect("the seed can be read"));
        }
    }
}
