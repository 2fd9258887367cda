//! The simulated back end passes the suite that every back end must pass.

use hal::conformance::CASES;
use hal::sim::{ClinicianScript, PatientScript, SimRoom};

#[tokio::test(start_paused = true)]
async fn the_simulated_room_conforms() {
    for case in CASES {
        let room = SimRoom::new(PatientScript::default(), ClinicianScript::default());
        case.run(&room).await.unwrap_or_else(|violation| panic!("{}: {violation}", case.name));
    }
}
