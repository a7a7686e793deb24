// @ts-check
/** The page: wires store, requests and views together. */
import { candidatesView } from "./answer/candidates.js";
import { factsView } from "./answer/facts.js";
import { failureView, fitView, messageView } from "./answer/notices.js";
import { skipLink, theoryView } from "./answer/theory.js";
import { verdictView } from "./answer/verdict.js";
import { copyButtons, exportPanel } from "./export/export_panel.js";
import { createFields } from "./fields/fields.js";
import { mapView } from "./map/map_view.js";
import { createCamera, showOpenedScenes } from "./plan/camera.js";
import { planView } from "./plan/plan_view.js";
import { tileLayer } from "./plan/tile_layer.js";
import { createLatency, publishProgress } from "./requests/progress.js";
import { createRequests } from "./requests/requests.js";
import { openAddress, undoButtons, writeAddress } from "./scene/address.js";
import { presetButtons } from "./scene/presets.js";
import { embedView } from "./shared/embed.js";
import { roving } from "./shared/roving.js";
import { themeSwitch } from "./shared/theme.js";
import { createActions } from "./state/actions.js";
import { INITIAL_STATE } from "./state/page_state.js";
import { createStore } from "./state/store.js";
import { player } from "./timeline/player.js";
import { timelineView } from "./timeline/timeline_view.js";

const store = createStore(INITIAL_STATE);
const requests = createRequests(store);
const latency = createLatency(store);
const actions = createActions(store, requests, latency);
const camera = createCamera(store);

// The order of watchers: first the theme, whose colours the views use, then the plan, then the other views.
embedView(store);
themeSwitch(store);
theoryView(store);
planView(store, actions, camera);
latency.measure();
tileLayer(store, actions);
const fields = createFields(store, actions, camera);
factsView(store);
candidatesView(store, actions);
verdictView(store);
failureView(store, actions);
fitView(store, actions);
messageView(store);
mapView(store, actions);
timelineView(store, actions);
player(store, actions);
exportPanel(store, actions, fields);
copyButtons(store, actions);
presetButtons(store, actions);
showOpenedScenes(store, camera);
openAddress(store, actions);
undoButtons(store, writeAddress(store));
for (const group of document.querySelectorAll("[role=toolbar]")) if (group instanceof HTMLElement) roving(group);
skipLink();
publishProgress(store);
