//! Pilotage for Python: logs as `NumPy` arrays, the navigator over flights, the filter and the vehicle models by
//! themselves, predicted routes, matched patches. Everything is done by the crates of the method; here is only what
//! hands it over. The global lock of Python is let go while they work.

// Functions take what Python's calls hand over, most of it by name and with a usual value.
#![allow(clippy::needless_pass_by_value, clippy::too_many_arguments)]

mod arrays;
mod correlation;
mod error;
mod field_array;
mod filter;
mod flight;
mod interruption;
mod log;
mod model_of_state;
mod prediction;
mod replay;
mod run;
mod sized_filter;
mod topic;
mod vehicle;

/// The compiled part of the package `pilotage`, which re-exports all of it.
#[pyo3::pymodule(name = "_native", gil_used = false)]
mod native {
    #[pymodule_export]
    use crate::correlation::{PythonMatch, correlate, match_patch};
    #[pymodule_export]
    use crate::error::{FilterError, PilotageError};
    #[pymodule_export]
    use crate::filter::{PythonCorrection, PythonUkf};
    #[pymodule_export]
    use crate::flight::{PythonFlight, read_flight};
    #[pymodule_export]
    use crate::log::{PythonLog, read_log};
    #[pymodule_export]
    use crate::prediction::{PythonPrediction, predict_route};
    #[pymodule_export]
    use crate::replay::{replay, replay_scenario, scenario_names};
    #[pymodule_export]
    use crate::run::{PythonRun, read_run};
    #[pymodule_export]
    use crate::topic::{PythonField, PythonTopic};
    #[pymodule_export]
    use crate::vehicle::{PythonControls, PythonVehicle, vehicle_models};

    /// Adds the version of the package.
    #[pymodule_init]
    fn version(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods as _;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
