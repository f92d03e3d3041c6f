// A worker with the program `flying`.
import { initSync, worker } from "./pkg/pilotage_worker_flying.js";
import { serve } from "./worker.js";

serve(initSync, worker);
