// A worker with the program `whole`.
import { initSync, worker } from "./pkg/pilotage_worker_whole.js";
import { serve } from "./worker.js";

serve(initSync, worker);
