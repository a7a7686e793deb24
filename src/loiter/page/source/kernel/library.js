// @ts-nocheck
// What is between the kernel and the page: problems, maneuvers, their answers, certificates and files.
// Generated from the Python of loiter 0.1.0 by `make generate`; do not edit.
import * as errors from "./errors.js";
import * as geodesic from "./geodesic.js";
import * as kernel from "./kernel.js";
import * as arrays from "./arrays.js";
import * as shapes from "./shapes.js";
import { Complex, np } from "./numpy.js";
import { ElementTree, Tuple, Values, abs, accumulate, add, all, and, any, any_, append_, asdict, bit_and, bit_or, bool, cached, capitalize_, cmath, complex, conjugate_, copy_, csv, dict, div, encode_, enumerate, enumeration, eq, escape, float, floordiv, format, ge, get_, gt, has, heappop, heappush, index_, int, invert, io, isinstance, item, items_, iter, iter_items, join_, json, le, len, letters, list, lower_, lt, map, math, max, min, mod, mul, name_of, ne, neg, next, or, pairwise, partial, plain, pop_, pow, range, removeprefix_, removesuffix_, replace, replace_, repr, reversed, round, round_, rows, set, set_item, set_of, slice, sliced, sorted, str, struct, sub, sum, tolist_, truth, tuple, values_, with_middle, zip } from "./python.js";
import { shapely } from "./shapes.js";

function plan(placed, slot = null) {
let _, best, document, entry, first, maneuver, maneuvers, others, problem, start_x, start_y;
problem = placed.problem;
[best, others] = iter(((slot == null) ? best_and_others(problem) : best_and_others_in_slot(problem, slot)));
const chained1 = [...iter(best), ...iter(others)];
[first, ..._] = iter(chained1);
maneuvers = chained1;
document = answer(best, others, placed.frame);
for ([entry, maneuver] of rows(zip([document, ...iter(item(document, "alternatives"))], maneuvers))) {
set_item(entry, "track", track(maneuver));
}
[[start_x, ..._], [start_y, ..._]] = iter(list(iter("xy")).map((axis) => item(item(document, "track"), axis)));
return bit_or(document, new Map([["optimal", len(best)], ["other_turn_later_s", _other_turn_later_s(maneuvers)], ["instruction", instruction(first)], ["command", command(problem, slot)], ["python", python(problem, slot)], ["reduced", new Map([["x", start_x], ["y", start_y], ["radius", problem.radius]])]]));
}

function certificate(placed, slot = null) {
let checked, first, instants, series, switches, tolerance_m;
[first, tolerance_m] = iter([first_maneuver(placed.problem, slot), placed.problem.tolerance_m]);
checked = ((slot == null) ? certify(first, tolerance_m) : certify_slot(first, slot));
instants = list(iter(checked.history(STEPS))).flatMap((piece) => list(iter(piece)).map((instant) => instant));
series = new Map(list(iter(Instant._fields)).map((name) => [name, list(iter(instants)).map((instant) => instant[name])]));
switches = list(iter(checked.switches)).map((switch_) => switch_.time_s);
return new Map([["certificate", checked.to_dict()], ["series", bit_or(series, new Map([["switches_s", switches]]))]]);
}

function first_maneuver(problem, slot = null) {
let _, first;
[first, ..._] = iter(((slot == null) ? all_fastest(problem) : arrivals(problem, slot)));
return first;
}

function lap(maneuver) {
let R, V, aircraft, c, centre, east, first, g, i, join, names, north, orbit, r, rows_, s, side, speed, step, time, wx, wy, x, y;
[aircraft, orbit, side] = iter([maneuver.aircraft, maneuver.orbit, item(SIDES, maneuver.turn)]);
[r, V, centre] = iter([aircraft.turn_radius_m, aircraft.airspeed_m_s, maneuver.orbit_at_join]);
[R, [wx, wy]] = iter([radius_in_turns(orbit, aircraft), relative_wind(orbit, aircraft, maneuver.wind)]);
[join, step] = iter([maneuver.join, div(mul(2.0, math.pi), LAP_STEPS)]);
first = kernel.phase_of(div(sub(join.east_m, centre.east_m), r), div(sub(join.north_m, centre.north_m), r), side, wx, wy);
[time, speed, rows_] = iter([maneuver.duration_s, null, []]);
for (i of iter(range(add(LAP_STEPS, 1)))) {
[x, y, c, s, g] = iter(kernel.hold_pose(add(first, mul(i, step)), side, R, wx, wy));
time = ((speed == null) ? time : add(time, div(mul(mul(step, R), r), mul(mul(0.5, add(speed, g)), V))));
[east, north] = iter(orbit.centre_after(time));
append_(rows_, [time, add(east, mul(r, x)), add(north, mul(r, y)), heading_of(c, s), 0.0, mul(side, R)]);
speed = g;
}
names = ["time_s", "east_m", "north_m", "heading_deg", "x", "y"];
return new Map(list(iter(zip(names, zip(...iter(rows_))))).map((one) => iter(one)).map(([name, column]) => [name, list(column)]));
}

function leg_plan(placed, asked) {
let leg, plan, problem;
plan = _planned(placed, asked);
[leg, problem] = iter([plan.leg, _problem(placed, asked)]);
return bit_or(plan.to_dict(), new Map([["sentence", str(plan)], ["instruction", leg_instruction(plan)], ["command", leg_command(problem, leg)], ["python", leg_python(problem, leg)], ["altitudes", _altitudes(plan)], ["maneuver", _whole(plan, placed)]]));
}

function leg_fence_check(placed, asked, fence, margin_m) {
let found;
found = check(fence, _planned(placed, asked), margin_m);
return bit_or(found.to_dict(), new Map([["sentence", found.sentence()]]));
}

function leg_file(placed, asked, ending) {
if ((placed.frame == null)) {
throw errors.InvalidArgument("frame", `is missing: a ${str(ending)} file needs places on Earth`);
}
return leg_text(_planned(placed, asked), ending, placed.frame, Autopilot.ARDUPILOT);
}

function fence_check(placed, fence, margin_m, slot = null) {
let found;
found = check(fence, first_maneuver(placed.problem, slot), margin_m);
return bit_or(found.to_dict(), new Map([["sentence", found.sentence()]]));
}

function clear_plan(placed, fence, margin_m) {
let answer, best, found, values;
found = _search(placed, fence, margin_m);
best = found.maneuver;
answer = new Map([["sentence", found.sentence], ["least_s", (eq(found.least_s, math.inf) ? null : found.least_s)], ["blocking", list(found.blocking)], ["later_s", null], ["instruction", null], ["lap", null], ["maneuver", null]]);
if ((best == null)) {
return answer;
}
values = bit_or(maneuver_values(best, placed.frame), new Map([["track", track(best)]]));
return bit_or(answer, new Map([["later_s", found.later_s], ["instruction", instruction(best)], ["lap", lap(best)], ["maneuver", values]]));
}

function clear_maneuver(placed, fence, margin_m) {
let found;
found = _search(placed, fence, margin_m);
if ((found.maneuver == null)) {
throw errors.InvalidArgument("fence", `lets no plan through that a file could have: ${str(found.sentence)}`);
}
return found.maneuver;
}

const CircleZone = struct(class extends Values {
constructor(name, east_m, north_m, radius_m, inclusion = false) {
super();
this.name = name;
this.east_m = east_m;
this.north_m = north_m;
this.radius_m = radius_m;
this.inclusion = inclusion;
this.__post_init__();
}
__post_init__() {
const self = this;
number(`zone ${repr(self.name)} east_m`, self.east_m, "metres");
number(`zone ${repr(self.name)} north_m`, self.north_m, "metres");
positive(`zone ${repr(self.name)} radius_m`, self.radius_m, "metres");
}
}, ["name", "east_m", "north_m", "radius_m", "inclusion"], 'CircleZone');

const PolygonZone = struct(class extends Values {
constructor(name, corners, inclusion = false) {
super();
this.name = name;
this.corners = corners;
this.inclusion = inclusion;
this.__post_init__();
}
__post_init__() {
let corners, following, problem, where;
const self = this;
where = `zone ${repr(self.name)}`;
corners = list(iter(self.corners)).map((corner) => _checked_corner(where, corner));
following = [...iter(sliced(corners, 1, null, null)), ...iter(sliced(corners, null, 1, null))];
corners = list(iter(zip(corners, following))).map((one) => iter(one)).filter(([corner, after]) => truth(_differ(corner, after))).map(([corner, after]) => corner);
if (lt(len(corners), LEAST_CORNERS)) {
throw errors.InvalidArgument(where, `has ${len(corners)} different corners: a polygon needs ${str(LEAST_CORNERS)}`);
}
(self["corners"] = tuple(corners));
if (truth((problem = shapes.invalidity(self._polygon)))) {
throw errors.InvalidArgument(where, problem);
}
}
get _edges() { return cached(this, "_edges", () => {
const self = this;
return edges_of([self]);
}); }
get _polygon() { return cached(this, "_polygon", () => {
let polygon;
const self = this;

polygon = shapely.Polygon(self.corners);
shapely.prepare(polygon);
return polygon;
}); }
}, ["name", "corners", "inclusion"], 'PolygonZone');

const Fence = struct(class extends Values {
constructor(zones) {
super();
this.zones = zones;
this.__post_init__();
}
check(maneuver, margin_m = null) {
let approaches, breaches, closest, closest_one, flown, least, nearest, ordered, path, places, zone, zones;
const self = this;
[flown, maneuver] = iter([maneuver, (truth(isinstance(maneuver, LegPlan)) ? maneuver.entry : maneuver)]);
arrays.unchecked("maneuver", maneuver, Maneuver);
margin_m = ((margin_m == null) ? default_margin_m(maneuver.orbit) : not_negative("margin_m", margin_m, "metres"));
path = flown_path(flown);
_check_start(self, maneuver.start);
approaches = [];
for ([zones, closest] of rows(zip(_by_kind(self), approach(self, path.pieces, margin_m)))) {
places = zip(tolist_(closest.distance), tolist_(closest.piece), tolist_(closest.time_s));
approaches = add(approaches, list(iter(zip(zones, places))).map((one) => iter(one)).map(([zone, place]) => [zone, PlaceInPath(...iter(place))]));
}
[zone, nearest] = iter(min(approaches, { key: ((each) => item(each, 1).distance) }));
breaches = list(iter(approaches)).map((one) => iter(one)).filter(([zone, near]) => le(near.distance, add(margin_m, TOUCH_M))).map(([zone, near]) => _breach(zone, near, path, maneuver));
ordered = tuple(sorted(breaches, { key: ((breach) => breach.time_s) }));
least = min(ordered, { key: ((breach) => breach.clearance_m), default: null });
closest_one = or(least, () => _at(zone, nearest.distance, nearest, path, maneuver));
return FenceCheck(margin_m, closest_one, ordered, decimals_of(maneuver.orbit));
}
__post_init__() {
let zone;
const self = this;
(self["zones"] = tuple(self.zones));
if (!truth(self.zones)) {
throw errors.InvalidArgument("fence", "has no zones");
}
for (zone of iter(self.zones)) {
if (!truth(isinstance(zone, CircleZone, PolygonZone))) {
throw errors.InvalidArgument("fence", `has ${repr(zone)}: a zone is a CircleZone or a PolygonZone`);
}
}
_check_common_point(list(iter(self.zones)).filter((zone) => truth(zone.inclusion)).map((zone) => zone));
}
get polygons() { return cached(this, "polygons", () => {
const self = this;
return tuple(list(iter(self.zones)).filter((zone) => truth(isinstance(zone, PolygonZone))).map((zone) => zone));
}); }
get circle_zones() { return cached(this, "circle_zones", () => {
const self = this;
return tuple(list(iter(self.zones)).filter((zone) => truth(isinstance(zone, CircleZone))).map((zone) => zone));
}); }
get edges() { return cached(this, "edges", () => {
const self = this;
return edges_of(self.polygons);
}); }
get circles() { return cached(this, "circles", () => {
let rows_;
const self = this;
rows_ = list(iter(self.circle_zones)).map((z) => [z.east_m, z.north_m, z.radius_m, (truth(z.inclusion) ? -1.0 : 1.0)]);
return Circles(...iter(np.array(rows_, float).reshape(-1, 4).T));
}); }
signed_distances(east_m, north_m) {
let allowed, inside, nearest, outside;
const self = this;

outside = sub(np.hypot(sub(self.circles.x, east_m), sub(self.circles.y, north_m)), self.circles.radius);
if (!truth(self.polygons)) {
return [np.empty(0), mul(self.circles.sign, outside)];
}
nearest = np.minimum.reduceat(to_edge(east_m, north_m, self.edges), self.edges.first);
inside = shapely.contains_xy(list(iter(self.polygons)).map((zone) => zone._polygon), east_m, north_m);
allowed = eq(inside, list(iter(self.polygons)).map((zone) => zone.inclusion));
return [np.where(allowed, nearest, neg(nearest)), mul(self.circles.sign, outside)];
}
violated(east_m, north_m) {
let deepest, distances, sides, zones;
const self = this;
distances = self.signed_distances(east_m, north_m);
zones = [...iter(self.polygons), ...iter(self.circle_zones)];
sides = list(iter(distances)).flatMap((each) => list(iter(tolist_(each))).map((side) => side));
deepest = min(sides);
return (lt(deepest, 0.0) ? item(zones, index_(sides, deepest)) : null);
}
}, ["zones"], 'Fence');

function check_points(maneuver, chord_error_m) {
let count;
count = sum(step_counts(maneuver, null, chord_error_m));
if (gt(count, MAX_POINTS)) {
throw errors.InvalidArgument("chord_error_m", `is ${format(chord_error_m, `g`)}: the file would have ${format(count, `,`)} points; the page writes at most ${format(MAX_POINTS, `,`)}, loiter plan --save writes more`);
}
}

function _map(draw, has_ground, ending, ...shown) {
return draw(...iter(list(iter(shown)).map((arguments_) => _chart(ending, arguments_, has_ground))));
}

function geojson(...charts) {
let features, lines;
features = list(iter(charts)).flatMap((chart) => list(iter(_features(chart))).map((feature) => feature));
lines = join_(",\n", list(iter(features)).map((feature) => json.dumps(feature, { allow_nan: false })));
return encode_(`{"type": "FeatureCollection", "features": [\n${str(lines)}\n]}\n`);
}

function kml(...charts) {
let chart, first, others, outermost, parent, top;
outermost = root("kml", "http://www.opengis.net/kml/2.2");
top = child(outermost, "Document", undefined, new Map([]));
[first, ...others] = iter(charts);
child(top, "name", (truth(others) ? `${len(charts)} aircraft, ${str(Turn_described(first.maneuver.turn))}` : _name(first)), new Map([]));
child(top, "open", "1", new Map([]));
_view(top, charts);
add_styles(top, STYLES);
for (chart of iter(charts)) {
parent = top;
if (truth(chart.name)) {
parent = child(top, "Folder", undefined, new Map([]));
child(parent, "name", `${str(chart.name)}: ${str(_name(chart))}`, new Map([]));
}
_placemarks(parent, chart);
}
return document(outermost);
}

function gpx(...charts) {
let chart, first, here, latitude, location, longitude, mark, metadata, others, points, top, track;
location = new Map([["xmlns:xsi", SCHEMA], ["xsi:schemaLocation", `${str(NAMESPACE)} ${str(NAMESPACE)}/gpx.xsd`]]);
top = root("gpx", NAMESPACE, new Map([...iter_items(location), ["version", "1.1"], ["creator", "loiter"]]));
[first, ...others] = iter(charts);
metadata = (truth(others) ? `${len(charts)} aircraft, ${str(Turn_described(first.maneuver.turn))}` : gpx__name(first));
child(child(top, "metadata", undefined, new Map([])), "name", metadata, new Map([]));
for (chart of iter(charts)) {
for (mark of iter(chart.marks)) {
here = _place(top, "wpt", chart, mark.latitude_deg, mark.longitude_deg);
child(here, "name", (truth(chart.name) ? `${str(chart.name)} ${str(mark.kind)}` : mark.kind), new Map([]));
child(here, "desc", `${str(mark.action)} at ${format(mark.time_s, `.2f`)} s, heading ${format(mark.heading_deg, `.1f`)} deg`, new Map([]));
child(here, "type", mark.kind, new Map([]));
}
}
_centre(top, max(charts, { key: ((chart) => chart.maneuver.duration_s) }));
for (chart of iter(charts)) {
track = child(top, "trk", undefined, new Map([]));
child(track, "name", (truth(chart.name) ? `${str(chart.name)}: ${str(gpx__name(chart))}` : gpx__name(chart)), new Map([]));
points = child(track, "trkseg", undefined, new Map([]));
for ([latitude, longitude] of rows(_track(chart))) {
_place(points, "trkpt", chart, latitude, longitude);
}
}
return document(top);
}

function _table(ending, arguments_) {
let counts;
counts = step_counts(arguments_.maneuver, arguments_.spacing_m, arguments_.chord_error_m);
return table(vertices(arguments_.maneuver, counts), arguments_.frame, _above_sea_m(arguments_));
}

function _plan(ending, arguments_) {
let airspeed_m_s, fence;
fence = ((arguments_.site == null) ? null : arguments_.site.fence_document);
if ((arguments_.fence != null)) {
fence = fence_document(arguments_.fence);
}
airspeed_m_s = arguments_.maneuver.aircraft.airspeed_m_s;
return qgcplan(_mission(ending, arguments_), arguments_.autopilot, airspeed_m_s, fence);
}

function _waypoints(ending, arguments_) {
if (((arguments_.frame != null) && eq(arguments_.autopilot, Autopilot.PX4))) {
throw errors.InvalidArgument("autopilot", `is px4, which would fly to the home line of a ${str(ending)} file as to its first waypoint: write a .plan file for PX4`);
}
return wpl(_mission(ending, arguments_));
}

const Format = struct(class extends Tuple {
constructor(endings, kind, media_type, name, use, content = null) {
super();
this.endings = endings;
this.kind = kind;
this.media_type = media_type;
this.name = name;
this.use = use;
this.content = content;

}
toString() {
const self = this;
return `${str(join_(" or ", self.endings))} (${str(self.use)})`;
}
}, ["endings", "kind", "media_type", "name", "use", "content"], 'Format');

function _chart(ending, arguments_, has_ground) {
let above_ground, altitude_m, frame, shown;
frame = _frame(ending, arguments_);
above_ground = and(has_ground, () => eq(arguments_.datum.reference, AltitudeReference.GROUND));
altitude_m = (truth(above_ground) ? arguments_.altitude_m : _above_sea_m(arguments_));
shown = chart(arguments_.maneuver, frame, altitude_m, arguments_.spacing_m, arguments_.chord_error_m);
return replace(shown, { above_ground: above_ground, name: arguments_.name });
}

function _features(chart) {
let features, shared;
features = [...iter(map(_segment, chart.lines)), ...iter(map(_mark, chart.marks)), _circle(chart)];
shared = (truth(chart.name) ? new Map([["aircraft", chart.name]]) : new Map([]));
if ((chart.altitude_m != null)) {
set_item(shared, "altitude_m", chart.altitude_m);
}
return list(iter(features)).map((feature) => new Map([...iter_items(feature), ["properties", new Map([...iter_items(item(feature, "properties")), ...iter_items(shared)])]]));
}

function root(tag, namespace, attributes = null) {
return ElementTree.Element(tag, new Map([["xmlns", namespace], ...iter_items(or(attributes, () => new Map([])))]));
}

function child(parent, tag, text = null, attributes = new Map()) {
let element;
element = ElementTree.SubElement(parent, tag, attributes);
if ((text != null)) {
element.text = str(text);
}
return element;
}

const Turn = enumeration({ CW: 'cw', CCW: 'ccw', EITHER: 'either' });
function Turn_other(self) {
return get_(new Map([[Turn.CW, Turn.CCW], [Turn.CCW, Turn.CW]]), self, self);
}
function Turn_described(self) {
return get_(new Map([[Turn.CW, "clockwise"], [Turn.CCW, "counter-clockwise"]]), self, "either way");
}

function _name(chart) {
let maneuver;
maneuver = chart.maneuver;
return (truth(maneuver.word) ? `${str(maneuver.word)}, ${str(Turn_described(maneuver.turn))}` : Turn_described(maneuver.turn));
}

function _view(parent, charts) {
let away_m, chart, maneuver, view;
chart = max(charts, { key: ((each) => each.maneuver.orbit_at_join.distance_m(each.maneuver.start)) });
maneuver = chart.maneuver;
view = child(parent, "LookAt", undefined, new Map([]));
child(view, "longitude", format(chart.centre_longitude_deg, DEGREES), new Map([]));
child(view, "latitude", format(chart.centre_latitude_deg, DEGREES), new Map([]));
child(view, "altitude", ((chart.altitude_m == null) ? "0" : chart.altitude_m), new Map([]));
child(view, "heading", "0", new Map([]));
child(view, "tilt", "0", new Map([]));
away_m = max(maneuver.orbit.radius_m, maneuver.orbit_at_join.distance_m(maneuver.start));
child(view, "range", `${format(mul(VIEW_DISTANCE, away_m), `.1f`)}`, new Map([]));
child(view, "altitudeMode", _mode(chart), new Map([]));
}

function add_styles(parent, colours) {
let colour, name, style;
for ([name, colour] of rows(items_(colours))) {
style = child(child(parent, "Style", undefined, new Map([["id", name]])), "LineStyle", undefined, new Map([]));
child(style, "color", colour, new Map([]));
child(style, "width", "3", new Map([]));
}
}

function _placemarks(top, chart) {
let line, mark, place, properties;
for (line of iter(chart.lines)) {
properties = segment_properties(line);
mark = _placemark(top, item(properties, "does"), line.segment.letter, properties, chart);
_geometry(mark, "LineString", chart, zip(line.longitude_deg, line.latitude_deg));
}
mark = _placemark(top, `hold ${str(Turn_described(chart.maneuver.turn))}`, "circle", circle_properties(chart), chart);
_geometry(mark, "LineString", chart, zip(...iter(reversed(chart.circle))));
for (place of iter(chart.marks)) {
mark = _placemark(top, `${str(place.kind)}: ${str(place.action)}`, null, mark_properties(place), chart);
_geometry(mark, "Point", chart, [[place.longitude_deg, place.latitude_deg]]);
}
}

function document(element) {
let text;
ElementTree.indent(element);
text = ElementTree.tostring(element, { encoding: "UTF-8", xml_declaration: true });
return add(text, "\n");
}

function gpx__name(chart) {
return `${str(or(chart.maneuver.word, () => "on the circle"))}, ${str(Turn_described(chart.maneuver.turn))}`;
}

function _place(parent, tag, chart, latitude, longitude) {
let east, place, west;
east = `${format(longitude, `${String(DEGREES)}`)}`;
west = (eq(float(east), 180.0) ? replace_(east, "180.", "-180.") : east);
place = child(parent, tag, undefined, new Map([["lat", `${format(latitude, `${String(DEGREES)}`)}`], ["lon", west]]));
if ((chart.altitude_m != null)) {
child(place, "ele", chart.altitude_m, new Map([]));
}
return place;
}

function _centre(top, chart) {
let centre, maneuver;
maneuver = chart.maneuver;
centre = _place(top, "wpt", chart, chart.centre_latitude_deg, chart.centre_longitude_deg);
child(centre, "name", "centre", new Map([]));
child(centre, "desc", `hold ${str(Turn_described(maneuver.turn))}, radius ${format(maneuver.orbit.radius_m, `g`)} m`, new Map([]));
child(centre, "type", "centre", new Map([]));
}

function _track(chart) {
let line, track;
track = list(iter(sliced(chart.marks, null, 1, null))).map((mark) => [mark.latitude_deg, mark.longitude_deg]);
for (line of iter(chart.lines)) {
track = add(track, sliced(list(zip(line.latitude_deg, line.longitude_deg)), 1, null, null));
}
return track;
}

function step_counts(maneuver, spacing_m, chord_error_m, bend_per_m = 0.0) {
let counts, limits;
if ((spacing_m != null)) {
spacing_m = positive("spacing_m", spacing_m, "metres");
}
chord_error_m = positive("chord_error_m", chord_error_m, "metres");
counts = list(iter(maneuver.segments)).map((segment) => _least_count(maneuver, segment, spacing_m, chord_error_m, bend_per_m));
if (gt(sum(counts), MAX_VERTICES)) {
limits = add(`a chord error of ${format(chord_error_m, `g`)} m`, ((spacing_m == null) ? "" : ` and a spacing of ${format(spacing_m, `g`)} m`));
throw errors.InvalidArgument("track", `would have more than ${format(MAX_VERTICES, `,`)} points with ${str(limits)}`);
}
return tuple(list(iter(counts)).map((count) => max(1, math.ceil(count))));
}

function table(track, frame, altitude_m) {
let columns, rows_, text;
columns = _columns(track, frame);
if ((altitude_m != null)) {
set_item(columns, "altitude_m", mul([altitude_m], track.time_s.size));
}
text = io.StringIO({ newline: "" });
rows_ = csv.writer(text, { lineterminator: "\n" });
rows_.writerow(columns);
rows_.writerows(zip(...iter(values_(columns))));
return encode_(text.getvalue());
}

function vertices(maneuver, counts) {
let last, times;

times = list(iter(zip(maneuver.segments, counts))).map((one) => iter(one)).map(([segment, count]) => add(segment.start_s, div(mul(segment.duration_s, np.arange(count)), count)));
last = (truth(maneuver.segments) ? item(maneuver.segments, -1) : null);
append_(times, np.array([((last == null) ? 0.0 : add(last.start_s, last.duration_s))]));
return samples_at(np.concatenate(times), maneuver.start, maneuver.segments, maneuver.aircraft, maneuver.wind);
}

function _above_sea_m(arguments_) {
return ((arguments_.altitude_m == null) ? null : arguments_.datum.above_sea_m(arguments_.altitude_m));
}

function fence_document(fence) {
let circles, polygons;
circles = list(iter(fence.zones)).filter((zone) => truth(isinstance(zone, PlacedCircle))).map((zone) => new Map([["circle", new Map([["center", [zone.latitude_deg, zone.longitude_deg]], ["radius", zone.radius_m]])], ["inclusion", zone.inclusion], ["version", AREA_VERSION]]));
polygons = list(iter(fence.zones)).filter((zone) => truth(isinstance(zone, PlacedPolygon))).map((zone) => new Map([["polygon", list(iter(_clockwise(zone.corners))).map((corner) => list(corner))], ["inclusion", zone.inclusion], ["version", AREA_VERSION]]));
return new Map([["circles", circles], ["polygons", polygons], ["version", FENCE_VERSION]]);
}

function qgcplan(mission, autopilot, airspeed_m_s, fence = null) {
let document;
document = new Map([["fileType", "Plan"], ["version", 1], ["groundStation", "QGroundControl"], ["geoFence", ((fence == null) ? NO_FENCE : fence)], ["rallyPoints", new Map([["points", []], ["version", 2]])], ["mission", new Map([["version", 2], ["firmwareType", int(autopilot)], ["vehicleType", FIXED_WING], ["cruiseSpeed", airspeed_m_s], ["hoverSpeed", airspeed_m_s], ["globalPlanAltitudeMode", _common_mode(mission)], ["plannedHomePosition", list(mission.home)], ["items", list(iter(enumerate(mission.items, { start: 1 }))).map((one) => iter(one)).map(([number, item_]) => _written(number, item_))]])]]);
return add(encode_(json.dumps(document, { indent: 4, allow_nan: false })), "\n");
}

function _mission(ending, arguments_) {
let altitude_m, datum, frame, plan;
[frame, datum, altitude_m] = iter([_frame(ending, arguments_), arguments_.datum, arguments_.altitude_m]);
if ((eq(arguments_.autopilot, Autopilot.PX4) && eq(datum.reference, AltitudeReference.GROUND))) {
throw errors.InvalidArgument("altitude_reference", "is ground: PX4 flies no missions with altitudes above the ground");
}
if ((altitude_m == null)) {
throw errors.InvalidArgument("altitude_m", `is missing: a ${str(ending)} file needs ${str(datum.unit)}`);
}
plan = mission(arguments_.maneuver, frame, altitude_m, arguments_.spacing_m, arguments_.chord_error_m, datum, arguments_.along_path, arguments_.autopilot);
return ((arguments_.site == null) ? plan : replace(plan, { home: _kept_home(arguments_.site, plan.home) }));
}

const Autopilot = enumeration({ ARDUPILOT: 3, PX4: 12 });
function Autopilot_described(self) {
return item(new Map([[Autopilot.ARDUPILOT, "ArduPilot"], [Autopilot.PX4, "PX4"]]), self);
}

function wpl(mission) {
let home, lines;
home = MissionItem(MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, [0.0, 0.0, 0.0, 0.0], ...iter(mission.home));
lines = list(iter(enumerate([home, ...iter(mission.items)]))).map((one) => iter(one)).map(([number, item_]) => _line(number, item_));
return encode_(join_("\n", [HEADER, ...iter(lines), ""]));
}

function _frame(ending, arguments_) {
if ((arguments_.frame == null)) {
throw errors.InvalidArgument("frame", `is missing: a ${str(ending)} file needs places on Earth; .csv does not`);
}
return arguments_.frame;
}

const AltitudeReference = enumeration({ MSL: 'msl', HOME: 'home', GROUND: 'ground' });

function chart(maneuver, frame, altitude_m, spacing_m, chord_error_m) {
let bend, centre_latitude, centre_longitude, counts, latitude, lines, longitude, marks, orbit, polygon, switches, track;
orbit = maneuver.orbit_at_join;
bend = _bend_per_m(maneuver, frame, orbit);
counts = step_counts(maneuver, spacing_m, chord_error_m, bend);
track = vertices(maneuver, counts);
[latitude, longitude] = iter(degrees(frame, track.east_m, track.north_m));
switches = list(iter(range(add(len(counts), 1)))).map((i) => sum(sliced(counts, null, i, null)));
lines = list(iter(zip(maneuver.segments, switches, sliced(switches, 1, null, null)))).map((one) => iter(one)).map(([segment, first, last]) => SegmentLine(segment, sliced(latitude, first, add(last, 1), null), sliced(longitude, first, add(last, 1), null)));
marks = _marks(maneuver, frame, track, switches, latitude, longitude);
[[centre_latitude], [centre_longitude]] = iter(degrees(frame, [orbit.east_m], [orbit.north_m]));
polygon = degrees(frame, ...iter(circle_polygon(orbit, chord_error_m, bend)));
return Chart(maneuver, altitude_m, lines, marks, polygon, centre_latitude, centre_longitude);
}

function _segment(line) {
let parts;
parts = list(iter(cut_line(line.longitude_deg, line.latitude_deg))).map((part) => _coordinates(part));
return _feature(...iter(geojson__geometry("LineString", parts)), segment_properties(line));
}

function _mark(mark) {
let coordinates;
[coordinates] = iter(_coordinates([Position(mark.longitude_deg, mark.latitude_deg)]));
return _feature("Point", coordinates, mark_properties(mark));
}

function _circle(chart) {
let latitude, longitude, parts;
[latitude, longitude] = iter(chart.circle);
parts = list(iter(cut_ring(longitude, latitude))).map((part) => [_coordinates(part)]);
return _feature(...iter(geojson__geometry("Polygon", parts)), circle_properties(chart));
}

function _mode(chart) {
if ((chart.altitude_m == null)) {
return "clampToGround";
}
return (truth(chart.above_ground) ? "relativeToGround" : "absolute");
}

function segment_properties(line) {
let segment;
segment = line.segment;
return new Map([["kind", "segment"], ["letter", segment.letter], ["does", item(ACTIONS, segment.letter)], ["start_s", segment.start_s], ["duration_s", segment.duration_s], ["length_m", segment.length_m], ["curvature_per_m", segment.curvature_per_m]]);
}

function _placemark(parent, title, style, properties, chart) {
let altitude, data, key, mark, name, value;
mark = placemark(parent, title, style);
data = child(mark, "ExtendedData", undefined, new Map([]));
name = (truth(chart.above_ground) ? "altitude_above_ground_m" : "altitude_m");
altitude = ((chart.altitude_m == null) ? new Map([]) : new Map([[name, chart.altitude_m]]));
for ([key, value] of rows(items_(new Map([...iter_items(properties), ...iter_items(altitude)])))) {
child(child(data, "Data", undefined, new Map([["name", key]])), "value", value, new Map([]));
}
return mark;
}

function _geometry(mark, kind, chart, positions) {
add_geometry(mark, kind, _mode(chart), list(iter(positions)).map((position) => _position(chart, ...iter(position))));
}

function circle_properties(chart) {
let maneuver;
maneuver = chart.maneuver;
return new Map([["kind", "circle"], ["turn", maneuver.turn], ["radius_m", maneuver.orbit.radius_m], ["centre_latitude_deg", round(chart.centre_latitude_deg, DECIMALS)], ["centre_longitude_deg", round(chart.centre_longitude_deg, DECIMALS)], ["word", maneuver.word], ["duration_s", maneuver.duration_s], ["length_m", maneuver.length_m]]);
}

function mark_properties(mark) {
return new Map([["kind", mark.kind], ["does", mark.action], ["time_s", mark.time_s], ["heading_deg", mark.heading_deg], ["track_deg", mark.track_deg], ["ground_speed_m_s", mark.ground_speed_m_s]]);
}

function positive(argument, value, unit) {
let largest, least, x;
x = float(arrays.same(value, unit));
[least, largest] = iter((eq(sliced(unit, null, 6, null), "metres") ? [LEAST_SIZE, LARGEST_SIZE] : [0.0, math.inf]));
if (!((lt(0.0, x) && lt(x, math.inf)) && (le(least, x) && le(x, largest)))) {
arrays.refuse(argument, value, `a positive, finite number of ${str(unit)}${str(_range(x))}`);
}
return x;
}

function _least_count(maneuver, segment, spacing_m, chord_error_m, bend_per_m) {
let _, by_chord, by_spacing, root, speed, v;
v = maneuver.aircraft.airspeed_m_s;
if (eq(segment.curvature_per_m, 0.0)) {
[_, speed] = iter(maneuver.over_ground(segment.start));
} else {
speed = add(v, maneuver.wind.speed_m_s);
}
root = math.hypot(mul(v, math.sqrt(abs(segment.curvature_per_m))), mul(speed, math.sqrt(bend_per_m)));
by_chord = div(root, math.sqrt(mul(8.0, chord_error_m)));
by_spacing = ((spacing_m == null) ? 0.0 : div(speed, spacing_m));
return mul(segment.duration_s, max(by_chord, by_spacing));
}

function _columns(track, frame) {
let course, heading, latitude, longitude, places, tangents;
[heading, course] = iter([tolist_(track.heading_deg), tolist_(track.track_deg)]);
places = new Map([]);
if ((frame != null)) {
[latitude, longitude] = iter(degrees(frame, track.east_m, track.north_m));
places = new Map([["latitude_deg", latitude], ["longitude_deg", longitude]]);
heading = true_headings(frame, heading, latitude, longitude);
course = true_headings(frame, course, latitude, longitude);
}
tangents = list(iter(course)).map((angle) => heading_vector(angle));
return new Map([["time_s", tolist_(track.time_s)], ...iter_items(places), ["north_m", tolist_(track.north_m)], ["east_m", tolist_(track.east_m)], ["heading_deg", heading], ["track_deg", course], ["ground_speed_m_s", tolist_(track.ground_speed_m_s)], ["tangent_north", list(iter(tangents)).map((one) => iter(one)).map(([_0, north]) => north)], ["tangent_east", list(iter(tangents)).map((one) => iter(one)).map(([east, _]) => east)], ["curvature_right_per_m", tolist_(sub(0.0, track.ground_curvature_per_m))]]);
}

function samples_at(time_s, start, segments, aircraft, wind) {
let V, curvature, east, ends, heading, held, north, paths, pieces;

if (!truth(segments)) {
held = np.full(time_s.size, 1.0);
[east, north, heading] = iter(list(iter([start.east_m, start.north_m, wrapped(start.heading_deg)])).map((value) => mul(held, value)));
return Samples(time_s, east, north, heading, mul(0.0, held), ...iter(_over_ground(heading, mul(0.0, held), aircraft, wind)));
}
ends = [...iter(np.searchsorted(time_s, list(iter(sliced(segments, 1, null, null))).map((segment) => segment.start_s))), time_s.size];
pieces = list(iter(zip(segments, [0, ...iter(ends)], ends))).map((one) => iter(one)).map(([segment, a, b]) => [segment, sliced(time_s, a, b, null)]);
V = aircraft.airspeed_m_s;
paths = list(iter(pieces)).map((one) => iter(one)).map(([segment, times]) => along(segment, mul(sub(times, segment.start_s), V), aircraft, wind));
[east, north, heading] = iter(list(iter(zip(...iter(paths)))).map((parts) => np.concatenate(parts)));
curvature = np.concatenate(list(iter(pieces)).map((one) => iter(one)).map(([segment, times]) => np.full(times.size, segment.curvature_per_m)));
return Samples(time_s, east, north, heading, curvature, ...iter(_over_ground(heading, curvature, aircraft, wind)));
}

const PlacedCircle = struct(class extends Tuple {
constructor(name, latitude_deg, longitude_deg, radius_m, inclusion = false) {
super();
this.name = name;
this.latitude_deg = latitude_deg;
this.longitude_deg = longitude_deg;
this.radius_m = radius_m;
this.inclusion = inclusion;

}
local(frame) {
let east, north;
const self = this;
[[east, north]] = iter(_local(self.name, frame, [[self.latitude_deg, self.longitude_deg]]));
return CircleZone(self.name, east, north, self.radius_m, self.inclusion);
}
}, ["name", "latitude_deg", "longitude_deg", "radius_m", "inclusion"], 'PlacedCircle');

const PlacedPolygon = struct(class extends Tuple {
constructor(name, corners, inclusion = false) {
super();
this.name = name;
this.corners = corners;
this.inclusion = inclusion;

}
local(frame) {
const self = this;
return PolygonZone(self.name, tuple(_local(self.name, frame, self.corners)), self.inclusion);
}
}, ["name", "corners", "inclusion"], 'PlacedPolygon');

function _clockwise(corners) {
let pairs, twice_area;
pairs = zip(corners, [...iter(sliced(corners, 1, null, null)), item(corners, 0)]);
twice_area = sum(list(iter(pairs)).map((one) => iter(one)).map(([[lat, lon], [after_lat, after_lon]]) => mul(math.remainder(sub(lon, after_lon), 360.0), add(lat, after_lat))));
return (gt(twice_area, 0.0) ? [item(corners, 0), ...iter(reversed(sliced(corners, 1, null, null)))] : corners);
}

function _common_mode(mission) {
let frames;
frames = set_of(list(iter(mission.items)).filter((item_) => ne(item_.frame, Frame.NOWHERE)).map((item_) => item_.frame));
return (eq(len(frames), 1) ? item(ALTITUDE_MODES, pop_(frames)) : 0);
}

function _written(number, one) {
let numbers, params;
numbers = [...iter(one.params), one.latitude_deg, one.longitude_deg, one.altitude_m];
params = list(iter(numbers)).map((value) => (truth(math.isnan(value)) ? null : value));
return new Map([["AMSLAltAboveTerrain", null], ["Altitude", item(params, -1)], ["AltitudeMode", get_(ALTITUDE_MODES, one.frame, 0)], ["autoContinue", one.autocontinue], ["command", int(one.command)], ["doJumpId", number], ["frame", int(one.frame)], ["params", params], ["type", "SimpleItem"]]);
}

function mission(maneuver, frame, altitude_m, spacing_m = null, chord_error_m = 1.0, datum = MEAN_SEA_LEVEL, along_path = false, autopilot = Autopilot.ARDUPILOT) {
let centre, centre_place, home_m, home_place, items, kind, loiter, name, orbit, params, places, start, value, waypoints;
for ([name, value, kind] of rows([["maneuver", maneuver, Maneuver], ["frame", frame, LocalFrame]])) {
arrays.unchecked(name, value, kind);
}
arrays.unchecked("datum", datum, AltitudeDatum);
altitude_m = datum.checked(altitude_m);
chord_error_m = positive("chord_error_m", chord_error_m, "metres");
home_m = datum.planned_home_m(altitude_m);
orbit = checked_orbit(maneuver.orbit);
if ((truth(along_path) || (spacing_m != null))) {
waypoints = path_waypoints(maneuver, spacing_m, chord_error_m);
} else {
waypoints = approach_waypoints(maneuver, autopilot);
}
params = with_circle(MavCommand.NAV_LOITER_UNLIM, NO_PARAMS, orbit.radius_m, maneuver.turn);
[start, centre] = iter([Waypoint(maneuver.start.east_m, maneuver.start.north_m), Waypoint(orbit.east_m, orbit.north_m)]);
[home_place, places, centre_place] = with_middle(places_in_degrees(frame, [start, ...iter(waypoints), centre]), 1, 1);
items = list(iter(zip(waypoints, places))).map((one) => iter(one)).map(([w, place]) => MissionItem(MavCommand.NAV_WAYPOINT, datum.frame, [0.0, w.acceptance_m, 0.0, 0.0], ...iter(place), altitude_m));
loiter = MissionItem(MavCommand.NAV_LOITER_UNLIM, datum.frame, params, ...iter(centre_place), altitude_m);
return Mission([...iter(items), loiter], [...iter(home_place), home_m]);
}

function _kept_home(site, planned) {
let _, latitude_deg, longitude_deg;
[latitude_deg, longitude_deg, _] = iter(site.home);
if (truth(math.isnan(add(latitude_deg, longitude_deg)))) {
return planned;
}
return [latitude_deg, longitude_deg, ((site.home_altitude_m == null) ? item(planned, 2) : site.home_altitude_m)];
}

const MissionItem = struct(class extends Tuple {
constructor(command, frame, params, latitude_deg, longitude_deg, altitude_m, autocontinue = true) {
super();
this.command = command;
this.frame = frame;
this.params = params;
this.latitude_deg = latitude_deg;
this.longitude_deg = longitude_deg;
this.altitude_m = altitude_m;
this.autocontinue = autocontinue;

}
}, ["command", "frame", "params", "latitude_deg", "longitude_deg", "altitude_m", "autocontinue"], 'MissionItem');

const MavCommand = enumeration({ NAV_WAYPOINT: 16, NAV_LOITER_UNLIM: 17, NAV_LOITER_TURNS: 18, NAV_LOITER_TIME: 19, NAV_LAND: 21, NAV_LOITER_TO_ALT: 31, DO_ORBIT: 34, DO_REPOSITION: 192 });

const Frame = enumeration({ ABOVE_SEA: 0, NOWHERE: 2, ABOVE_HOME: 3, ABOVE_TERRAIN: 10 });

function _line(number, item_) {
let fields, integers, numbers;
numbers = [...iter(item_.params), item_.latitude_deg, item_.longitude_deg, item_.altitude_m];
integers = [number, int(eq(number, 0)), int(item_.frame), int(item_.command)];
fields = [...iter(list(iter(integers)).map((n) => `${format(n, `d`)}`)), ...iter(list(iter(numbers)).map((x) => `${format(x, `.9f`)}`))];
return join_("\t", [...iter(fields), `${format(int(item_.autocontinue), `d`)}`]);
}

function _bend_per_m(maneuver, frame, orbit) {
let away_m, largest_latitude, places;
places = [maneuver.start, ...iter(list(iter(maneuver.segments)).map((segment) => segment.end))];
away_m = add(max(list(iter(places)).map((pose) => math.hypot(pose.east_m, pose.north_m))), mul(4.0, maneuver.aircraft.turn_radius_m));
away_m = max(away_m, add(math.hypot(orbit.east_m, orbit.north_m), orbit.radius_m));
largest_latitude = add(math.radians(abs(frame.latitude_deg)), div(away_m, LEAST_EARTH_RADIUS_M));
return add(div(mul(1.09, math.tan(min(math.radians(LARGEST_LATITUDE_DEG), largest_latitude))), LEAST_EARTH_RADIUS_M), BEND_PER_M);
}

function degrees(frame, east_m, north_m) {
let latitude, longitude;

[latitude, longitude] = iter(frame.to_geodetic(east_m, north_m));
if (truth(any_(np.isnan(latitude)))) {
throw errors.OutOfRange(`the maneuver goes more than ${format(div(REACH_M, 1000.0), `g`)} km from the frame's origin ${format(frame.latitude_deg, `g`)} ${format(frame.longitude_deg, `g`)}: take the circle's centre as the origin`);
}
return [tolist_(round_(latitude, places_DECIMALS)), tolist_(round_(longitude, places_DECIMALS))];
}

const SegmentLine = struct(class extends Tuple {
constructor(segment, latitude_deg, longitude_deg) {
super();
this.segment = segment;
this.latitude_deg = latitude_deg;
this.longitude_deg = longitude_deg;

}
}, ["segment", "latitude_deg", "longitude_deg"], 'SegmentLine');

function _marks(maneuver, frame, track, at, latitude, longitude) {
let actions, headings, lat, lon, rows_, tracks;
[lat, lon] = iter([list(iter(at)).map((i) => item(latitude, i)), list(iter(at)).map((i) => item(longitude, i))]);
headings = true_headings(frame, item(track.heading_deg, at), lat, lon);
tracks = true_headings(frame, item(track.track_deg, at), lat, lon);
actions = list(iter(maneuver.segments)).map((segment) => item(ACTIONS, segment.letter));
rows_ = zip(_kinds(len(maneuver.segments)), [...iter(actions), `hold ${str(Turn_described(maneuver.turn))}`], tolist_(item(track.time_s, at)), lat, lon, headings, tracks, tolist_(item(track.ground_speed_m_s, at)));
return list(iter(rows_)).map((row) => Mark(...iter(row)));
}

function circle_polygon(orbit, chord_error_m, bend_per_m = 0.0) {
let angle, curvature, sides;

curvature = add(div(1.0, orbit.radius_m), bend_per_m);
sides = max(LEAST_SIDES, math.ceil(mul(mul(mul(2.0, math.pi), orbit.radius_m), math.sqrt(div(curvature, mul(8.0, chord_error_m))))));
if (gt(sides, MAX_VERTICES)) {
throw errors.InvalidArgument("circle", `would have more than ${format(MAX_VERTICES, `,`)} points with a chord error of ${format(chord_error_m, `g`)} m`);
}
angle = div(mul(mul(2.0, math.pi), mod(np.arange(add(sides, 1)), sides)), sides);
return [add(orbit.east_m, mul(orbit.radius_m, np.cos(angle))), add(orbit.north_m, mul(orbit.radius_m, np.sin(angle)))];
}

const Chart = struct(class extends Tuple {
constructor(maneuver, altitude_m, lines, marks, circle, centre_latitude_deg, centre_longitude_deg, above_ground = false, name = "") {
super();
this.maneuver = maneuver;
this.altitude_m = altitude_m;
this.lines = lines;
this.marks = marks;
this.circle = circle;
this.centre_latitude_deg = centre_latitude_deg;
this.centre_longitude_deg = centre_longitude_deg;
this.above_ground = above_ground;
this.name = name;

}
}, ["maneuver", "altitude_m", "lines", "marks", "circle", "centre_latitude_deg", "centre_longitude_deg", "above_ground", "name"], 'Chart');

function cut_line(longitude_deg, latitude_deg) {
let _, a, b, band, band_of_b, crossing, edge, line, part, parts, shifted, start, step;
line = _unwrapped(longitude_deg, latitude_deg);
[start, ..._] = iter(line);
[part, band] = iter([[start], _band(start.longitude)]);
parts = [[part, band]];
for ([a, b] of rows(pairwise(line))) {
while (ne(band, (band_of_b = _band(b.longitude)))) {
step = (gt(band_of_b, band) ? 1 : -1);
edge = add(180.0, mul(360.0, (gt(step, 0) ? band : sub(band, 1))));
crossing = _crossing(a, b, edge);
append_(part, crossing);
[part, band] = iter([[crossing], add(band, step)]);
append_(parts, [part, band]);
}
append_(part, b);
}
shifted = list(iter(parts)).map((one) => iter(one)).map(([part, band]) => _shifted(part, band));
return or(list(iter(shifted)).filter((part) => gt(len(set(part)), 1)).map((part) => part), () => sliced(shifted, null, 1, null));
}

function _coordinates(part) {
return list(iter(part)).map((one) => iter(one)).map(([longitude, latitude]) => [round(longitude, DECIMALS), round(latitude, DECIMALS)]);
}

function _feature(kind, coordinates, properties) {
return new Map([["type", "Feature"], ["geometry", new Map([["type", kind], ["coordinates", coordinates]])], ["properties", properties]]);
}

function geojson__geometry(kind, parts) {
let part;
if (gt(len(parts), 1)) {
return [`Multi${str(kind)}`, parts];
}
[part] = iter(parts);
return [kind, part];
}

const Position = struct(class extends Tuple {
constructor(longitude, latitude) {
super();
this.longitude = longitude;
this.latitude = latitude;

}
}, ["longitude", "latitude"], 'Position');

function cut_ring(longitude_deg, latitude_deg) {
let _, bands, first, last, longitudes, parts, ring;
ring = _unwrapped(longitude_deg, latitude_deg);
[first, _, last] = with_middle(ring, 1, 1);
if (gt(abs(sub(last.longitude, first.longitude)), 180.0)) {
return [_counter_clockwise(_closed_at_pole(ring))];
}
longitudes = list(iter(ring)).map((position) => position.longitude);
bands = range(_band(min(longitudes)), add(_band(max(longitudes)), 1));
parts = list(iter(bands)).map((k) => _shifted(_clipped(_clipped(ring, sub(mul(360.0, k), 180.0), 1), add(mul(360.0, k), 180.0), -1), k));
return or(list(iter(parts)).filter((part) => ne(_area(part), 0.0)).map((part) => _counter_clockwise(part)), () => [_shifted(ring, bands.start)]);
}

function placemark(parent, title, style = null) {
let mark;
mark = child(parent, "Placemark", undefined, new Map([]));
child(mark, "name", title, new Map([]));
if ((style != null)) {
child(mark, "styleUrl", `#${str(style)}`, new Map([]));
}
return mark;
}

function add_geometry(mark, kind, mode, positions) {
let shape;
shape = child(mark, kind, undefined, new Map([]));
if (eq(kind, "LineString")) {
child(shape, "tessellate", "1", new Map([]));
}
child(shape, "altitudeMode", mode, new Map([]));
child(shape, "coordinates", join_(" ", positions), new Map([]));
}

function _position(chart, longitude, latitude) {
let place;
place = `${format(longitude, `${String(DEGREES)}`)},${format(latitude, `${String(DEGREES)}`)}`;
return ((chart.altitude_m == null) ? place : `${str(place)},${str(chart.altitude_m)}`);
}

function _range(x) {
if ((!truth(math.isfinite(x)) || eq(x, 0.0) || (le(LEAST_SIZE, abs(x)) && le(abs(x), LARGEST_SIZE)))) {
return "";
}
return `, from ${format(LEAST_SIZE, `g`)} to ${format(LARGEST_SIZE, `g`)} in size: this is too ${str((lt(abs(x), 1.0) ? "small" : "large"))}`;
}

function true_headings(frame, heading_deg, latitude, longitude) {
let true_deg;

true_deg = sub(np.asarray(heading_deg, float), frame.convergence_deg(latitude, longitude));
return list(iter(tolist_(true_deg))).map((heading) => wrapped(heading));
}

function heading_vector(heading_deg) {
let c, cq, flip, halves, heading, odd, quarters, rest, s, sq;
heading = math.fmod(heading_deg, 360.0);
quarters = math.floor(add(div(heading, 90.0), 0.5));
rest = math.radians(sub(heading, mul(90.0, quarters)));
halves = math.floor(mul(0.5, quarters));
[odd, flip] = iter([sub(quarters, mul(2.0, halves)), sub(halves, mul(2.0, math.floor(mul(0.5, halves))))]);
[sq, cq] = iter([sub(odd, mul(mul(2.0, odd), flip)), mul(sub(1.0, odd), sub(1.0, mul(2.0, flip)))]);
[s, c] = iter([math.sin(rest), math.cos(rest)]);
return [add(mul(sq, c), mul(cq, s)), sub(mul(cq, c), mul(sq, s))];
}

function wrapped(heading_deg) {
let heading;
heading = mod(heading_deg, 360.0);
return mul(heading, lt(heading, 360.0));
}

const Samples = struct(class extends Tuple {
constructor(time_s, east_m, north_m, heading_deg, curvature_per_m, track_deg, ground_speed_m_s, ground_curvature_per_m) {
super();
this.time_s = time_s;
this.east_m = east_m;
this.north_m = north_m;
this.heading_deg = heading_deg;
this.curvature_per_m = curvature_per_m;
this.track_deg = track_deg;
this.ground_speed_m_s = ground_speed_m_s;
this.ground_curvature_per_m = ground_curvature_per_m;

}
}, ["time_s", "east_m", "north_m", "heading_deg", "curvature_per_m", "track_deg", "ground_speed_m_s", "ground_curvature_per_m"], 'Samples');

function _over_ground(heading_deg, curvature_per_m, aircraft, wind) {
let angles, east, ground_curvature, h_east, h_north, north, speed, track_deg, v;

v = aircraft.airspeed_m_s;
if (eq(wind.speed_m_s, 0.0)) {
return [copy_(heading_deg), np.full_like(heading_deg, v), copy_(curvature_per_m)];
}
angles = np.radians(heading_deg);
[h_east, h_north] = iter([np.sin(angles), np.cos(angles)]);
[east, north] = iter(_velocity(h_east, h_north, aircraft, wind));
track_deg = wrapped(np.degrees(np.arctan2(east, north)));
speed = np.hypot(east, north);
ground_curvature = div(mul(mul(mul(v, v), curvature_per_m), add(mul(east, h_east), mul(north, h_north))), pow(speed, 3));
return [track_deg, speed, ground_curvature];
}

function along(segment, length_m, aircraft, wind) {
let radius_m, u;

[u, radius_m] = iter([item(CONTROLS, segment.letter), radius_of(segment, aircraft)]);
return tuple(np.broadcast_arrays(...iter(_flown(segment.start, u, length_m, radius_m, aircraft, wind, arrays.fly_arrays()))));
}

function _local(name, frame, places) {
let corner, east_m, i, latitudes, longitudes, north_m;
arrays.unchecked("frame", frame, LocalFrame);
[latitudes, longitudes] = iter(zip(...iter(places)));
[east_m, north_m] = iter(frame.to_local(latitudes, longitudes));
if (truth(any_(ne(east_m, east_m)))) {
i = int(ne(east_m, east_m).argmax());
corner = (gt(len(places), 1) ? `corner ${str(add(i, 1))} of ` : "");
throw errors.OutOfRange(`the fence cannot be checked: ${str(corner)}the zone ${repr(name)}, at ${str(degrees_of(...iter(item(places, i))))}, is more than ${format(div(REACH_M, 1000.0), `g`)} km from ${str(degrees_of(frame.latitude_deg, frame.longitude_deg))}`);
}
return list(zip(tolist_(east_m), tolist_(north_m)));
}

const AltitudeDatum = struct(class extends Values {
constructor(reference = AltitudeReference.MSL, home_altitude_m = null) {
super();
this.reference = reference;
this.home_altitude_m = home_altitude_m;
this.__post_init__();
}
__post_init__() {
let home_m, known;
const self = this;
if (!has(self.reference, tuple(AltitudeReference))) {
known = join_(", ", AltitudeReference);
throw errors.InvalidArgument("altitude_reference", `is ${repr(self.reference)}: it must be one of ${str(known)}`);
}
(self["reference"] = self.reference);
if ((self.home_altitude_m != null)) {
home_m = number("home_altitude_m", self.home_altitude_m, item(UNITS, AltitudeReference.MSL));
(self["home_altitude_m"] = _check_range("home_altitude_m", home_m));
}
}
get frame() {
const self = this;
return item(FRAMES, self.reference);
}
get unit() {
const self = this;
return item(UNITS, self.reference);
}
checked(altitude_m) {
let check;
const self = this;
check = (eq(self.reference, AltitudeReference.GROUND) ? positive : number);
return _check_range("altitude_m", check("altitude_m", altitude_m, self.unit));
}
above_sea_m(altitude_m) {
const self = this;
if (eq(self.reference, AltitudeReference.MSL)) {
return altitude_m;
}
if ((eq(self.reference, AltitudeReference.HOME) && (self.home_altitude_m != null))) {
return add(self.home_altitude_m, altitude_m);
}
if (eq(self.reference, AltitudeReference.HOME)) {
throw errors.InvalidArgument("home_altitude_m", "is missing: altitudes above home cannot be converted without it");
}
throw errors.InvalidArgument("altitude_reference", "is ground: how high that is above mean sea level is not known");
}
planned_home_m(altitude_m) {
const self = this;
if ((self.home_altitude_m != null)) {
return self.home_altitude_m;
}
if (eq(self.reference, AltitudeReference.MSL)) {
return altitude_m;
}
throw errors.InvalidArgument("home_altitude_m", `is missing: a mission in ${str(self.unit)} needs that of home, ${str(item(UNITS, AltitudeReference.MSL))}`);
}
}, ["reference", "home_altitude_m"], 'AltitudeDatum');

function number(argument, value, unit) {
let x;
x = float(arrays.same(value, unit));
if (!le(abs(x), LARGEST_SIZE)) {
arrays.refuse(argument, value, `a finite number of ${str(unit)}${str(_range(x))}`);
}
return x;
}

function _check_range(argument, altitude_m) {
if (gt(abs(altitude_m), HIGHEST_ITEM_M)) {
throw errors.InvalidArgument(argument, `is ${format(altitude_m, `g`)}: it must be from ${format(neg(HIGHEST_ITEM_M), `g`)} to ${format(HIGHEST_ITEM_M, `g`)} metres`);
}
return altitude_m;
}

const Maneuver = struct(class extends Values {
constructor(start, orbit, aircraft, turn, segments, miss_m, wind = CALM) {
super();
this.start = start;
this.orbit = orbit;
this.aircraft = aircraft;
this.turn = turn;
this.segments = segments;
this.miss_m = miss_m;
this.wind = wind;

}
get word() {
const self = this;
return join_("", list(iter(self.segments)).map((segment) => segment.letter));
}
get duration_s() {
const self = this;
return sum(list(iter(self.segments)).map((segment) => segment.duration_s));
}
get length_m() {
const self = this;
return sum(list(iter(self.segments)).map((segment) => segment.length_m));
}
get join() {
const self = this;
return (truth(self.segments) ? item(self.segments, -1).end : self.start);
}
get orbit_at_join() {
const self = this;
return self.orbit.after(self.duration_s);
}
get hold() {
const self = this;
return Hold(self.orbit, self.aircraft, self.wind, self.turn);
}
over_ground(pose) {
const self = this;
arrays.unchecked("pose", pose, Pose);
return over_ground(pose.heading_deg, self.aircraft, self.wind);
}
sample(step_s) {
const self = this;
step_s = positive("step_s", step_s, "seconds");
if (gt(div(self.duration_s, step_s), MAX_SAMPLES)) {
throw errors.InvalidArgument("step_s", `is ${str(step_s)}: it would take more than ${MAX_SAMPLES} samples`);
}
return samples(self.start, self.segments, self.aircraft, self.wind, step_s);
}
setpoints(step_s) {
const self = this;
return setpoints(self.sample(step_s));
}
toString() {
let decimals, windy;
const self = this;
if (!truth(self.segments)) {
return `On the circle already, ${str(Turn_described(self.turn))}: nothing to fly.`;
}
decimals = decimals_of(self.orbit);
windy = or(gt(self.wind.speed_m_s, 0.0), () => self.orbit.moves);
return `${str(self.word)}, ${str(Turn_described(self.turn))}: joins in ${format(self.duration_s, `.${String(decimals)}f`)} s after ${format(self.length_m, `.${String(decimals)}f`)} m${str((truth(windy) ? " through the air" : ""))}`;
}
}, ["start", "orbit", "aircraft", "turn", "segments", "miss_m", "wind"], 'Maneuver');

const LocalFrame = struct(class extends Values {
constructor(latitude_deg, longitude_deg) {
super();
this.latitude_deg = latitude_deg;
this.longitude_deg = longitude_deg;
this.__post_init__();
}
__post_init__() {
let latitude_deg, longitude_deg;
const self = this;
[latitude_deg, longitude_deg] = iter(checked_place("origin", self.latitude_deg, self.longitude_deg));
(self["latitude_deg"] = latitude_deg);
(self["longitude_deg"] = longitude_deg);
}
to_local(latitude_deg, longitude_deg) {
let _, east, north;
const self = this;
[east, north, _] = iter(geodesic.to_plane(self.latitude_deg, self.longitude_deg, latitude_deg, longitude_deg));
return [east, north];
}
to_geodetic(east_m, north_m) {
const self = this;
return geodesic.from_plane(self.latitude_deg, self.longitude_deg, east_m, north_m);
}
convergence_deg(latitude_deg, longitude_deg) {
let _, convergence;
const self = this;
[_, _, convergence] = iter(geodesic.to_plane(self.latitude_deg, self.longitude_deg, latitude_deg, longitude_deg));
return convergence;
}
place(pose) {
let heading, latitude, longitude;
const self = this;
arrays.unchecked("pose", pose, Pose);
[latitude, longitude] = iter(list(iter(self.to_geodetic(pose.east_m, pose.north_m))).map((value) => float(value)));
if (ne(latitude, latitude)) {
throw self._too_far(`${format(pose.east_m, `g`)} m east, ${format(pose.north_m, `g`)} m north`);
}
heading = sub(wrapped(pose.heading_deg), float(self.convergence_deg(latitude, longitude)));
return Place(latitude, longitude, wrapped(heading));
}
_too_far(where, hint = "") {
const self = this;
return errors.OutOfRange(`the place ${str(where)} is more than ${format(div(REACH_M, 1000.0), `g`)} km from the origin ${format(self.latitude_deg, `g`)} ${format(self.longitude_deg, `g`)}: the plane is not a good model of the Earth at that distance${str(hint)}`);
}
}, ["latitude_deg", "longitude_deg"], 'LocalFrame');

function checked_orbit(orbit) {
if (truth(orbit.moves)) {
throw errors.InvalidArgument("orbit", "moves over the ground: the loiter of a mission stays where it is");
}
if (!(le(LEAST_RADIUS_M, orbit.radius_m) && le(orbit.radius_m, LARGEST_RADIUS_M))) {
throw errors.InvalidArgument("orbit radius_m", `is ${format(orbit.radius_m, `g`)}: the loiter of a mission takes ${format(LEAST_RADIUS_M, `g`)} to ${format(LARGEST_RADIUS_M, `g`)} metres`);
}
return orbit;
}

function path_waypoints(maneuver, spacing_m, chord_error_m) {
let track;
track = vertices(maneuver, step_counts(maneuver, spacing_m, chord_error_m, BEND_PER_M));
if (gt(track.time_s.size, MAX_ITEMS)) {
throw errors.InvalidArgument("mission", add(`would have ${track.time_s.size} items: autopilots hold some ${MAX_ITEMS}; allow a larger chord error than ${format(chord_error_m, `g`)} m`, ((spacing_m == null) ? "" : ` or spacing than ${format(spacing_m, `g`)} m`)));
}
return tuple(map(Waypoint, tolist_(sliced(track.east_m, 1, null, null)), tolist_(sliced(track.north_m, 1, null, null))));
}

function approach_waypoints(maneuver, autopilot) {
let _, acceptance_m, ground_speed, straight;
straight = next(list(iter(maneuver.segments)).filter((segment) => eq(segment.letter, "S")).map((segment) => segment), null);
if ((ne(autopilot, Autopilot.ARDUPILOT) || (straight == null) || lt(straight.duration_s, LEAST_STRAIGHT_S))) {
return [];
}
[_, ground_speed] = iter(maneuver.over_ground(straight.start));
acceptance_m = float(round(min(mul(TAKE_OVER_S, ground_speed), LARGEST_ACCEPTANCE_M)));
return [Waypoint(maneuver.join.east_m, maneuver.join.north_m, acceptance_m)];
}

function with_circle(command, params, radius_m, turn) {
let first, fourth, new_, numbers, second, signed_m, third;
[numbers, new_] = iter([_circle_parameters(command), list(iter(params)).map((value) => float(value))]);
signed_m = signed_radius_m(radius_m, turn);
set_item(new_, sub(numbers.radius, 1), ((numbers.direction == null) ? signed_m : abs(signed_m)));
if ((numbers.direction != null)) {
set_item(new_, sub(numbers.direction, 1), float(lt(signed_m, 0.0)));
}
[first, second, third, fourth] = iter(new_);
return [first, second, third, fourth];
}

const Waypoint = struct(class extends Tuple {
constructor(east_m, north_m, acceptance_m = 0.0) {
super();
this.east_m = east_m;
this.north_m = north_m;
this.acceptance_m = acceptance_m;

}
}, ["east_m", "north_m", "acceptance_m"], 'Waypoint');

function places_in_degrees(frame, places) {
return list(zip(...iter(degrees(frame, list(iter(places)).map((p) => p.east_m), list(iter(places)).map((p) => p.north_m)))));
}

const Mission = struct(class extends Tuple {
constructor(items, home) {
super();
this.items = items;
this.home = home;

}
}, ["items", "home"], 'Mission');

function _kinds(segments) {
if (eq(segments, 0)) {
return ["join"];
}
return ["start", ...iter(mul(["switch"], sub(segments, 2))), ...iter(mul(["peel-off"], gt(segments, 1))), "join"];
}

const Mark = struct(class extends Tuple {
constructor(kind, action, time_s, latitude_deg, longitude_deg, heading_deg, track_deg, ground_speed_m_s) {
super();
this.kind = kind;
this.action = action;
this.time_s = time_s;
this.latitude_deg = latitude_deg;
this.longitude_deg = longitude_deg;
this.heading_deg = heading_deg;
this.track_deg = track_deg;
this.ground_speed_m_s = ground_speed_m_s;

}
}, ["kind", "action", "time_s", "latitude_deg", "longitude_deg", "heading_deg", "track_deg", "ground_speed_m_s"], 'Mark');

function _unwrapped(longitude_deg, latitude_deg) {
let longitudes;
longitudes = accumulate(longitude_deg, ((before, after) => add(after, mul(360.0, math.floor(add(div(sub(before, after), 360.0), 0.5))))));
return list(iter(zip(longitudes, latitude_deg))).map((one) => iter(one)).map(([longitude, latitude]) => Position(longitude, latitude));
}

function _band(longitude) {
return math.floor(div(add(longitude, 180.0), 360.0));
}

function _crossing(a, b, longitude) {
let share;
share = div(sub(longitude, a.longitude), sub(b.longitude, a.longitude));
return Position(longitude, add(a.latitude, mul(share, sub(b.latitude, a.latitude))));
}

function _shifted(part, band) {
return list(iter(part)).map((one) => iter(one)).map(([longitude, latitude]) => Position(min(180.0, max(-180.0, sub(longitude, mul(360.0, band)))), latitude));
}

function _counter_clockwise(ring) {
return (gt(_area(ring), 0.0) ? ring : sliced(ring, null, null, -1));
}

function _closed_at_pole(ring) {
let _, east, edge, first, last, line, pole, west;
line = sorted(list(iter(sliced(ring, null, -1, null))).map((one) => iter(one)).map(([longitude, latitude]) => Position(sub(longitude, mul(360.0, _band(longitude))), latitude)));
[first, _, last] = with_middle(line, 1, 1);
[_, edge] = iter(_crossing(last, replace(first, { longitude: add(first.longitude, 360.0) }), 180.0));
pole = math.copysign(90.0, edge);
[west, east] = iter([Position(-180.0, edge), Position(180.0, edge)]);
return [west, ...iter(line), east, Position(180.0, pole), Position(-180.0, pole), west];
}

function _clipped(ring, edge, side) {
let a, a_inside, b, b_inside, kept;
kept = [];
for ([a, b] of rows(pairwise(ring))) {
[a_inside, b_inside] = iter([ge(mul(side, sub(a.longitude, edge)), 0.0), ge(mul(side, sub(b.longitude, edge)), 0.0)]);
if (truth(a_inside)) {
append_(kept, a);
}
if (ne(a_inside, b_inside)) {
append_(kept, _crossing(a, b, edge));
}
}
return [...iter(kept), ...iter(sliced(kept, null, 1, null))];
}

function _area(ring) {
let _, x, y;
if (!truth(ring)) {
return 0.0;
}
[[x, y], ..._] = iter(ring);
return sum(list(iter(pairwise(ring))).map((one) => iter(one)).map(([a, b]) => sub(mul(sub(a.longitude, x), sub(b.latitude, y)), mul(sub(b.longitude, x), sub(a.latitude, y)))));
}

function _velocity(east, north, aircraft, wind) {
let wind_east, wind_north;
[wind_east, wind_north] = iter(wind.velocity_m_s);
return [add(mul(aircraft.airspeed_m_s, east), wind_east), add(mul(aircraft.airspeed_m_s, north), wind_north)];
}

function radius_of(segment, aircraft) {
let r;
r = aircraft.turn_radius_m;
return (has(abs(segment.curvature_per_m), [0.0, div(1.0, r)]) ? r : div(1.0, abs(segment.curvature_per_m)));
}

function _flown(start, u, length_m, r, aircraft, wind, fly) {
let _, east, heading, north, t, time_s, wind_east, wind_north;
[t, time_s] = iter([div(length_m, r), div(length_m, aircraft.airspeed_m_s)]);
[east, north, _, _] = iter(fly(0.0, 0.0, ...iter(heading_vector(start.heading_deg)), u, t));
[wind_east, wind_north] = iter(wind.velocity_m_s);
heading = heading_after(start.heading_deg, mul(u, t));
return [position_after(add(start.east_m, mul(r, east)), wind_east, time_s), position_after(add(start.north_m, mul(r, north)), wind_north, time_s), heading];
}

function degrees_of(latitude_deg, longitude_deg) {
let east, north;
[north, east] = iter([(ge(latitude_deg, 0.0) ? "N" : "S"), (ge(longitude_deg, 0.0) ? "E" : "W")]);
return `${format(abs(latitude_deg), `.6f`)} ${str(north)} ${format(abs(longitude_deg), `.6f`)} ${str(east)}`;
}

const Wind = struct(class extends Values {
constructor(speed_m_s, from_deg) {
super();
this.speed_m_s = speed_m_s;
this.from_deg = from_deg;
this.__post_init__();
}
__post_init__() {
const self = this;
_keep(self, new Map([["speed_m_s", not_negative("wind speed_m_s", self.speed_m_s, "metres per second")]]));
_keep(self, new Map([["from_deg", number("wind from_deg", self.from_deg, "degrees")]]));
}
get velocity_m_s() {
const self = this;
return wind_velocity(self.speed_m_s, self.from_deg);
}
}, ["speed_m_s", "from_deg"], 'Wind');

function _keep(value, fields = new Map()) {
let field, name;
for ([name, field] of rows(items_(fields))) {
(value[name] = field);
}
}

function not_negative(argument, value, unit) {
let x;
x = float(arrays.same(value, unit));
return ((le(0.0, x) && lt(x, math.inf)) ? x : arrays.refuse(argument, value, `zero or a positive, finite number of ${str(unit)}`));
}

function wind_velocity(speed_m_s, from_deg) {
let east, north;
[east, north] = iter(heading_vector(from_deg));
return [sub(0.0, mul(speed_m_s, east)), sub(0.0, mul(speed_m_s, north))];
}

const Hold = struct(class extends Values {
constructor(orbit, aircraft, wind, turn) {
super();
this.orbit = orbit;
this.aircraft = aircraft;
this.wind = wind;
this.turn = turn;

}
get least_bank_deg() {
const self = this;
return self._at(UPWIND).bank_deg;
}
get largest_bank_deg() {
const self = this;
return self._at(DOWNWIND).bank_deg;
}
get largest_bank_azimuth_deg() {
const self = this;
return self._at(DOWNWIND).azimuth_deg;
}
_at(phase) {
let _, bank_deg, c, heading_deg, r, s, scene, side, speed, track_deg, x, y;
const self = this;
[r, side] = iter([self.aircraft.turn_radius_m, item(SIDES, self.turn)]);
scene = [radius_in_turns(self.orbit, self.aircraft), ...iter(relative_wind(self.orbit, self.aircraft, self.wind))];
[x, y, c, s, _] = iter(kernel.hold_pose(phase, side, ...iter(scene)));
heading_deg = heading_of(c, s);
[track_deg, speed] = iter(over_ground(heading_deg, self.aircraft, self.wind));
bank_deg = self.aircraft.bank_deg(div(r, kernel.hold_rate(phase, side, ...iter(scene))));
return HoldPoint(heading_of(x, y), heading_deg, track_deg, speed, bank_deg);
}
}, ["orbit", "aircraft", "wind", "turn"], 'Hold');

const Pose = struct(class extends Values {
constructor(east_m, north_m, heading_deg, altitude_m = null) {
super();
this.east_m = east_m;
this.north_m = north_m;
this.heading_deg = heading_deg;
this.altitude_m = altitude_m;
this.__post_init__();
}
__post_init__() {
let east_m, north_m;
const self = this;
[east_m, north_m] = iter([number("pose east_m", self.east_m, "metres"), number("pose north_m", self.north_m, "metres")]);
_keep(self, new Map([["east_m", east_m], ["north_m", north_m], ["heading_deg", number("pose heading_deg", self.heading_deg, "degrees")]]));
if ((self.altitude_m != null)) {
_keep(self, new Map([["altitude_m", number("pose altitude_m", self.altitude_m, "metres")]]));
}
}
}, ["east_m", "north_m", "heading_deg", "altitude_m"], 'Pose');

function over_ground(heading_deg, aircraft, wind) {
let east, north;
if (eq(wind.speed_m_s, 0.0)) {
return [wrapped(heading_deg), aircraft.airspeed_m_s];
}
[east, north] = iter(_velocity(...iter(heading_vector(heading_deg)), aircraft, wind));
return [heading_of(east, north), math.hypot(east, north)];
}

function samples(start, segments, aircraft, wind, step_s) {
let ends_s, times;

if (!truth(segments)) {
return samples_at(np.zeros(1), start, segments, aircraft, wind);
}
ends_s = add(item(segments, -1).start_s, item(segments, -1).duration_s);
times = np.append(np.arange(0.0, mul(ends_s, sub(1.0, ROUNDING)), step_s), ends_s);
return samples_at(times, start, segments, aircraft, wind);
}

function setpoints(track) {
let course;

course = np.radians(track.track_deg);
return Setpoints(track.time_s, track.east_m, track.north_m, np.sin(course), np.cos(course), track.ground_curvature_per_m, track.ground_speed_m_s);
}

function decimals_of(orbit) {
return (ge(orbit.radius_m, 10.0) ? 1 : 3);
}

function checked_place(argument, latitude_deg, longitude_deg) {
let lat, lon, swapped;
lat = number(`${str(argument)} latitude_deg`, latitude_deg, "degrees");
lon = number(`${str(argument)} longitude_deg`, longitude_deg, "degrees");
if (gt(abs(lat), 90.0)) {
swapped = (le(abs(lon), 90.0) ? "; are latitude and longitude swapped?" : "");
throw errors.InvalidArgument(`${str(argument)} latitude_deg`, `is ${str(latitude_deg)}: it must be between -90 and 90 degrees${str(swapped)}`);
}
if (gt(abs(lon), 360.0)) {
throw errors.InvalidArgument(`${str(argument)} longitude_deg`, `is ${str(longitude_deg)}: it must be between -360 and 360 degrees`);
}
return [lat, lon];
}

const Place = struct(class extends Tuple {
constructor(latitude_deg, longitude_deg, heading_deg) {
super();
this.latitude_deg = latitude_deg;
this.longitude_deg = longitude_deg;
this.heading_deg = heading_deg;

}
}, ["latitude_deg", "longitude_deg", "heading_deg"], 'Place');

function _circle_parameters(command) {
let known;
known = next(list(iter(COMMANDS)).filter((known) => eq(known, command)).map((known) => known), null);
if ((known == null)) {
throw errors.InvalidArgument("command", `is ${str(command)}: it flies no circle; ${str(join_(", ", list(iter(COMMANDS)).map((c) => c.name)))} do`);
}
return item(COMMANDS, known);
}

function signed_radius_m(radius_m, turn) {
radius_m = positive("radius_m", radius_m, "metres");
return (truth(signs__counter_clockwise(turn)) ? neg(radius_m) : radius_m);
}

function heading_after(heading_deg, turned) {
return wrapped(sub(wrapped(heading_deg), mul(turned, math.degrees(1.0))));
}

function position_after(place, velocity, time_s) {
return add(place, mul(velocity, time_s));
}

function radius_in_turns(orbit, aircraft) {
return div(orbit.radius_m, aircraft.turn_radius_m);
}

function relative_wind(orbit, aircraft, wind) {
let circle, kind, name, value;
for ([name, value, kind] of rows([["orbit", orbit, Orbit], ["aircraft", aircraft, Aircraft], ["wind", wind, Wind]])) {
arrays.unchecked(name, value, kind);
}
circle = [orbit.velocity_east_m_s, orbit.velocity_north_m_s];
return RelativeWind(...iter(relative_velocity(wind.velocity_m_s, circle, aircraft.airspeed_m_s)));
}

function heading_of(east, north) {
return wrapped(math.degrees(math.atan2(east, north)));
}

const HoldPoint = struct(class extends Tuple {
constructor(azimuth_deg, heading_deg, track_deg, ground_speed_m_s, bank_deg) {
super();
this.azimuth_deg = azimuth_deg;
this.heading_deg = heading_deg;
this.track_deg = track_deg;
this.ground_speed_m_s = ground_speed_m_s;
this.bank_deg = bank_deg;

}
}, ["azimuth_deg", "heading_deg", "track_deg", "ground_speed_m_s", "bank_deg"], 'HoldPoint');

const Setpoints = struct(class extends Tuple {
constructor(time_s, east_m, north_m, tangent_east, tangent_north, curvature_per_m, speed_m_s) {
super();
this.time_s = time_s;
this.east_m = east_m;
this.north_m = north_m;
this.tangent_east = tangent_east;
this.tangent_north = tangent_north;
this.curvature_per_m = curvature_per_m;
this.speed_m_s = speed_m_s;

}
}, ["time_s", "east_m", "north_m", "tangent_east", "tangent_north", "curvature_per_m", "speed_m_s"], 'Setpoints');

const CircleParameters = struct(class extends Tuple {
constructor(radius, direction = null) {
super();
this.radius = radius;
this.direction = direction;

}
}, ["radius", "direction"], 'CircleParameters');

function signs__counter_clockwise(turn) {
if (!has(turn, [Turn.CW, Turn.CCW])) {
throw errors.InvalidArgument("turn", `is ${repr(str(turn))}: a circle is held cw or ccw`);
}
return eq(turn, Turn.CCW);
}

const RelativeWind = struct(class extends Tuple {
constructor(x, y) {
super();
this.x = x;
this.y = y;

}
get still() {
const self = this;
return bit_and(eq(self.x, 0.0), eq(self.y, 0.0));
}
}, ["x", "y"], 'RelativeWind');

function relative_velocity(air, circle, airspeed) {
let passes, wx, wy;
[wx, wy] = iter([sub(item(air, 0), item(circle, 0)), sub(item(air, 1), item(circle, 1))]);
passes = gt(math.hypot(wx, wy), mul(ROUNDING, add(math.hypot(...iter(air)), math.hypot(...iter(circle)))));
return [add(div(mul(wx, passes), airspeed), 0.0), add(div(mul(wy, passes), airspeed), 0.0)];
}

const Orbit = struct(class extends Values {
constructor(east_m, north_m, radius_m, turn = Turn.EITHER, velocity_east_m_s = 0.0, velocity_north_m_s = 0.0) {
super();
this.east_m = east_m;
this.north_m = north_m;
this.radius_m = radius_m;
this.turn = turn;
this.velocity_east_m_s = velocity_east_m_s;
this.velocity_north_m_s = velocity_north_m_s;
this.__post_init__();
}
__post_init__() {
let east_m, name, north_m;
const self = this;
[east_m, north_m] = iter([number("orbit east_m", self.east_m, "metres"), number("orbit north_m", self.north_m, "metres")]);
_keep(self, new Map([["east_m", east_m], ["north_m", north_m], ["radius_m", circle_radius_m("orbit radius_m", self.radius_m)]]));
if (!has(self.turn, tuple(Turn))) {
throw errors.InvalidArgument("turn", `is ${repr(self.turn)}: it must be cw, ccw or either`);
}
_keep(self, new Map([["turn", self.turn]]));
for (name of iter(["velocity_east_m_s", "velocity_north_m_s"])) {
_keep(self, new Map([...iter_items(new Map([[name, number(`orbit ${str(name)}`, self[name], "metres per second")]]))]));
}
}
get moves() {
const self = this;
return (ne(self.velocity_east_m_s, 0.0) || ne(self.velocity_north_m_s, 0.0));
}
after(time_s) {
let east_m, north_m;
const self = this;
if (!truth(self.moves)) {
return self;
}
[east_m, north_m] = iter(self.centre_after(number("time_s", time_s, "seconds")));
return replace(self, { east_m: east_m, north_m: north_m });
}
centre_after(time_s) {
let velocity_east, velocity_north;
const self = this;
[velocity_east, velocity_north] = iter([self.velocity_east_m_s, self.velocity_north_m_s]);
return [position_after(self.east_m, velocity_east, time_s), position_after(self.north_m, velocity_north, time_s)];
}
distance_m(pose) {
const self = this;
arrays.unchecked("pose", pose, Pose);
return math.hypot(sub(pose.east_m, self.east_m), sub(pose.north_m, self.north_m));
}
}, ["east_m", "north_m", "radius_m", "turn", "velocity_east_m_s", "velocity_north_m_s"], 'Orbit');

function circle_radius_m(argument, radius_m) {
if ((lt(neg(math.inf), float(radius_m)) && lt(float(radius_m), 0.0))) {
throw errors.InvalidArgument(argument, `is ${str(radius_m)}: it must be positive; the turn ccw holds counter-clockwise`);
}
return positive(argument, radius_m, "metres");
}

const Aircraft = struct(class extends Values {
constructor(airspeed_m_s, max_bank_deg = null, min_turn_radius_m = null, max_turn_rate_deg_s = null, climb_rate_m_s = null, descent_rate_m_s = null) {
super();
this.airspeed_m_s = airspeed_m_s;
this.max_bank_deg = max_bank_deg;
this.min_turn_radius_m = min_turn_radius_m;
this.max_turn_rate_deg_s = max_turn_rate_deg_s;
this.climb_rate_m_s = climb_rate_m_s;
this.descent_rate_m_s = descent_rate_m_s;
this.__post_init__();
}
__post_init__() {
let given, limits, name, value;
const self = this;
_keep(self, new Map([["airspeed_m_s", positive("airspeed_m_s", self.airspeed_m_s, "metres per second")]]));
limits = new Map(list(iter(TURN_LIMITS)).filter((name) => (self[name] != null)).map((name) => [name, self[name]]));
if (ne(len(limits), 1)) {
given = (truth(limits) ? `${str(join_(" and ", limits))} were given` : "none was given");
throw errors.InvalidArgument("turn limit", `is needed exactly once (${str(join_(" or ", TURN_LIMITS))}): ${str(given)}`);
}
for ([name, value] of rows(items_(limits))) {
_keep(self, new Map([...iter_items(new Map([[name, positive(name, value, item(TURN_LIMITS, name))]]))]));
}
if (((self.max_bank_deg != null) && ge(float(self.max_bank_deg), 90.0))) {
throw errors.InvalidArgument("max_bank_deg", `is ${str(self.max_bank_deg)}: it must be between 0 and 90 degrees`);
}
positive("turn radius", self.turn_radius_m, "metres; airspeed and turn limit together give it");
for (name of iter(["climb_rate_m_s", "descent_rate_m_s"])) {
if ((self[name] != null)) {
_keep(self, new Map([...iter_items(new Map([[name, positive(name, self[name], "metres per second")]]))]));
}
}
}
get turn_radius_m() {
const self = this;
if ((self.min_turn_radius_m != null)) {
return self.min_turn_radius_m;
}
if ((self.max_turn_rate_deg_s != null)) {
return radius_at_rate(self.airspeed_m_s, self.max_turn_rate_deg_s);
}

return radius_at_bank(self.airspeed_m_s, self.max_bank_deg);
}
bank_deg(radius_m) {
const self = this;
return math.degrees(math.atan2(mul(self.airspeed_m_s, self.airspeed_m_s), mul(STANDARD_GRAVITY_M_S2, radius_m)));
}
}, ["airspeed_m_s", "max_bank_deg", "min_turn_radius_m", "max_turn_rate_deg_s", "climb_rate_m_s", "descent_rate_m_s"], 'Aircraft');

function radius_at_rate(airspeed_m_s, turn_rate_deg_s) {
return div(airspeed_m_s, math.radians(turn_rate_deg_s));
}

function radius_at_bank(airspeed_m_s, bank_deg) {
return div(mul(airspeed_m_s, airspeed_m_s), mul(STANDARD_GRAVITY_M_S2, math.tan(math.radians(bank_deg))));
}

const SaveArguments = struct(class extends Tuple {
constructor(maneuver, frame, altitude_m, datum, spacing_m, chord_error_m, autopilot, along_path = false, site = null, name = "", fence = null) {
super();
this.maneuver = maneuver;
this.frame = frame;
this.altitude_m = altitude_m;
this.datum = datum;
this.spacing_m = spacing_m;
this.chord_error_m = chord_error_m;
this.autopilot = autopilot;
this.along_path = along_path;
this.site = site;
this.name = name;
this.fence = fence;

}
}, ["maneuver", "frame", "altitude_m", "datum", "spacing_m", "chord_error_m", "autopilot", "along_path", "site", "name", "fence"], 'SaveArguments');

const SceneField = struct(class extends Tuple {
constructor(name, path) {
super();
this.name = name;
this.path = path;

}
}, ["name", "path"], 'SceneField');

const Problem = struct(class extends Values {
constructor(pose, orbit, aircraft, wind = CALM, tolerance_m = 0.0) {
super();
this.pose = pose;
this.orbit = orbit;
this.aircraft = aircraft;
this.wind = wind;
this.tolerance_m = tolerance_m;
this.relative_wind = undefined;
this.__post_init__();
}
__post_init__() {
const self = this;
arrays.unchecked("pose", self.pose, Pose);
(self["relative_wind"] = relative_wind(self.orbit, self.aircraft, self.wind));
(self["tolerance_m"] = not_negative("tolerance_m", self.tolerance_m, "metres"));
}
get still() {
const self = this;
return self.relative_wind.still;
}
get has_closed_form() {
const self = this;
return self.still;
}
get radius() {
const self = this;
return radius_in_turns(self.orbit, self.aircraft);
}
get time_unit_s() {
const self = this;
return div(self.aircraft.turn_radius_m, self.aircraft.airspeed_m_s);
}
with_turn(turn) {
const self = this;
return replace(self, { orbit: replace(self.orbit, { turn: turn }) });
}
later(time_s) {
let flown_m, pose;
const self = this;
time_s = not_negative("lead_s", time_s, "seconds");
flown_m = mul(time_s, self.aircraft.airspeed_m_s);
pose = flown_from(self.pose, 0, flown_m, self.aircraft, self.wind);
return replace(self, { pose: pose, orbit: self.orbit.after(time_s) });
}
reduced() {
let orbit, r, reduced, status, x, y;
const self = this;
[orbit, r] = iter([self.orbit, self.aircraft.turn_radius_m]);
[x, y] = iter(arrays.reduce_states(...iter(self._relative_state())));
reduced = ReducedProblem(x, y, kernel.rounded_radius(self.radius), item(SIDES, orbit.turn), div(self.tolerance_m, r));
status = kernel.synthesis_status_of(reduced.x, reduced.y, reduced.R, reduced.tolerance);
if (eq(status, kernel.Status.RADIUS_TOO_SMALL)) {
throw errors.RadiusTooSmall(too_tight(orbit, self.aircraft), r);
}
if ((ne(status, kernel.Status.OK) || !truth(self._has_finite_results()))) {
throw self._too_large();
}
return reduced;
}
in_wind() {
let c, found, s, tolerance, wx, wy, x, y;
const self = this;
check_held(self.orbit, self.aircraft, self.relative_wind, self.wind);
[x, y, c, s] = iter(self._relative_state());
[wx, wy] = iter(self.relative_wind);
tolerance = div(self.tolerance_m, self.aircraft.turn_radius_m);
found = WindProblem(x, y, c, s, self.radius, item(SIDES, self.orbit.turn), wx, wy, tolerance);
if ((ne(kernel.wind_search_status_of(found), kernel.Status.OK) || !truth(self._has_finite_results()))) {
throw self._too_large();
}
return found;
}
_relative_state() {
let c, orbit, pose, r, s;
const self = this;
r = self.aircraft.turn_radius_m;
[pose, orbit] = iter([self.pose, self.orbit]);
[c, s] = iter(heading_vector(pose.heading_deg));
return [div(sub(pose.east_m, orbit.east_m), r), div(sub(pose.north_m, orbit.north_m), r), c, s];
}
_has_finite_results() {
const self = this;
return ((lt(0.0, mul(REACH, self.time_unit_s)) && lt(mul(REACH, self.time_unit_s), math.inf)) && lt(mul(REACH, self.aircraft.turn_radius_m), math.inf));
}
_too_large() {
const self = this;
return errors.OutOfRange(`the scene is too large for double precision: ${format(self.orbit.distance_m(self.pose), `g`)} m from the centre of a circle of ${format(self.orbit.radius_m, `g`)} m, with a turn radius of ${format(self.aircraft.turn_radius_m, `.4g`)} m at an airspeed of ${format(self.aircraft.airspeed_m_s, `.4g`)} m/s; distances must stay below 2**52 turn radii`);
}
}, ["pose", "orbit", "aircraft", "wind", "tolerance_m"], 'Problem');

const Slot = struct(class extends Values {
constructor(phase_deg, at_s = 0.0) {
super();
this.phase_deg = phase_deg;
this.at_s = at_s;
this.__post_init__();
}
__post_init__() {
const self = this;
(self["phase_deg"] = number("slot phase_deg", self.phase_deg, "degrees"));
(self["at_s"] = number("slot at_s", self.at_s, "seconds"));
}
}, ["phase_deg", "at_s"], 'Slot');

function slot_pose(slot, problem, time_s) {
let _, c, east, given, north, phase, r, s, then, x, y;
[given, r] = iter([problem.in_wind(), problem.aircraft.turn_radius_m]);
then = replace(slot, { at_s: sub(slot.at_s, time_s) });
phase = phase_at_start(then, given, problem.time_unit_s);
[x, y, c, s, _] = iter(kernel.hold_pose(phase, given.side, given.R, given.wx, given.wy));
[east, north] = iter(problem.orbit.centre_after(time_s));
return Pose(add(east, mul(r, x)), add(north, mul(r, y)), heading_of(c, s));
}

function drawn_svg(maneuver) {
let centre_x, centre_y, circle, corners, east, height, north, parts, radius, ring, size, start, title, tracks, view;
tracks = list(iter(maneuver.segments)).map((segment) => [segment.letter, drawing__track(segment, maneuver.aircraft, maneuver.wind)]);
circle = maneuver.orbit_at_join;
[east, north, radius] = iter([circle.east_m, circle.north_m, circle.radius_m]);
corners = [[sub(east, radius), sub(north, radius)], [add(east, radius), add(north, radius)]];
start = [maneuver.start.east_m, maneuver.start.north_m];
view = _view_of([...iter(corners), start, ...iter(list(iter(tracks)).map((one) => iter(one)).flatMap(([_0, track]) => list(iter(track)).map((point) => point)))]);
[centre_x, centre_y] = iter(view.pixels(east, north).split(","));
[title, height] = iter([escape(str(maneuver)), `${format(view.height, `.0f`)}`]);
size = `width="${format(WIDTH, `.0f`)}" height="${str(height)}" viewBox="0 0 ${format(WIDTH, `.0f`)} ${str(height)}"`;
ring = `cx="${str(centre_x)}" cy="${str(centre_y)}" r="${format(mul(view.scale, radius), `.1f`)}"`;
parts = [`<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="${str(title)}" ${str(size)}>`, `<title>${str(title)}</title>`, "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>", `<circle ${str(ring)} fill="none" stroke="black" stroke-width="${str(THIN)}"/>`, ...iter(list(iter(range(4))).map((quarter) => _direction(view, circle, maneuver.turn, quarter))), ...iter(list(iter(tracks)).map((one) => iter(one)).map(([letter, track]) => drawing__line(view, letter, track))), ...iter(list(iter(sliced(maneuver.segments, 1, null, null))).map((segment) => _dot(view, segment.start, "white"))), _dot(view, maneuver.join, "black"), _aircraft(view, maneuver.start), "</svg>"];
return join_("\n", parts);
}

const PlacedProblem = struct(class extends Tuple {
constructor(problem, frame) {
super();
this.problem = problem;
this.frame = frame;

}
}, ["problem", "frame"], 'PlacedProblem');

function _kind(word, other, vanishes) {
if (truth(vanishes)) {
return ((has("S", sliced(word, null, 2, null)) && has("S", sliced(other, null, 2, null))) ? "straight" : "switch");
}
return (eq(sliced(word, null, 1, null), sliced(other, null, 1, null)) ? "same" : "tie");
}

function best_and_others(problem) {
let best, known, others;
known = solve_problem(problem.with_turn(Turn.EITHER), kernel.synthesis_ranked, kernel.wind_search_ranked);
best = (truth(problem.has_closed_form) ? all_fastest(problem) : _tied(known, problem));
others = maneuvers(known);
return [best, tuple(list(iter(others)).filter((m) => !truth(any(list(iter(best)).map((b) => (eq(m.turn, b.turn) && eq(m.segments, b.segments)))))).map((m) => m))];
}

function best_and_others_in_slot(problem, slot) {
let best, both;
both = list(iter(arrivals(problem.with_turn(Turn.EITHER), slot))).map((m) => replace(m, { orbit: problem.orbit }));
best = next(list(iter(both)).filter((m) => has(problem.orbit.turn, [Turn.EITHER, m.turn])).map((m) => m));
return [[best], tuple(list(iter(both)).filter((m) => (m != best)).map((m) => m))];
}

function answer(best, others, frame = null) {
let alternatives, first, rest;
[first, ...rest] = iter(best);
alternatives = list(iter([...iter(rest), ...iter(others)])).map((m) => bit_or(maneuver_values(m, frame), new Map([["later_s", sub(m.duration_s, first.duration_s)]])));
return bit_or(maneuver_values(first, frame), new Map([["alternatives", alternatives]]));
}

function track(maneuver) {
let centre_east, centre_north, east, flown, north, orbit, time, x, y;
flown = vertices(maneuver, step_counts(maneuver, null, mul(CHORD_ERROR, maneuver.aircraft.turn_radius_m)));
[orbit, time] = iter([maneuver.orbit, flown.time_s]);
[centre_east, centre_north] = iter(orbit.centre_after(time));
[east, north] = iter([sub(flown.east_m, centre_east), sub(flown.north_m, centre_north)]);
[x, y] = iter(arrays.reducer(heading_vector)(east, north, flown.heading_deg, replace(orbit, { east_m: 0.0, north_m: 0.0 }), maneuver.aircraft));
return new Map([["time_s", tolist_(time)], ["east_m", tolist_(flown.east_m)], ["north_m", tolist_(flown.north_m)], ["heading_deg", tolist_(flown.heading_deg)], ["x", tolist_(x)], ["y", tolist_(y)]]);
}

function _other_turn_later_s(maneuvers) {
let first, other, others;
[first, ...others] = iter(maneuvers);
other = next(list(iter(others)).filter((m) => ne(m.turn, first.turn)).map((m) => m), null);
return ((other == null) ? null : sub(other.duration_s, first.duration_s));
}

function instruction(maneuver) {
let decimals, first, hold, later, next_action, now;
hold = `hold ${str(Turn_described(maneuver.turn))}`;
if (!truth(maneuver.segments)) {
return `${str(capitalize_(hold))}: you are on the circle.`;
}
[first, ...later] = iter(maneuver.segments);
decimals = (ge(maneuver.orbit.radius_m, 10.0) ? 2 : 3);
next_action = (truth(later) ? item(ACTIONS, item(later, 0).letter) : hold);
now = `${str(capitalize_(item(ACTIONS, first.letter)))} now, then ${str(next_action)} in ${format(first.duration_s, `.${String(decimals)}f`)} s.`;
return (truth(later) ? `${str(now)} ${str(capitalize_(hold))} from ${format(maneuver.duration_s, `.${String(decimals)}f`)} s.` : now);
}

function command(problem, slot = null) {
let limit, orbit, pose, velocity, wind, words;
[pose, orbit, wind] = iter([problem.pose, problem.orbit, problem.wind]);
limit = _given_limit(problem.aircraft);
words = ["loiter plan", _option("pose", pose.east_m, pose.north_m, pose.heading_deg), _option("orbit", orbit.east_m, orbit.north_m, orbit.radius_m)];
words = add(words, (ne(orbit.turn, Turn.EITHER) ? [`${str(item(OPTIONS, "turn"))} ${str(orbit.turn)}`] : []));
append_(words, _option("airspeed_m_s", problem.aircraft.airspeed_m_s));
append_(words, _option(limit, problem.aircraft[limit]));
words = add(words, (ne(wind, CALM) ? [_option("wind", wind.speed_m_s, wind.from_deg)] : []));
velocity = [orbit.velocity_east_m_s, orbit.velocity_north_m_s];
words = add(words, (truth(orbit.moves) ? [_option("orbit_velocity_m_s", ...iter(velocity))] : []));
words = add(words, (truth(problem.tolerance_m) ? [_option("tolerance_m", problem.tolerance_m)] : []));
words = add(words, (truth(slot) ? [_option("slot phase_deg", slot.phase_deg)] : []));
words = add(words, ((truth(slot) && truth(slot.at_s)) ? [_option("slot at_s", slot.at_s)] : []));
return join_(" ", words);
}

function python(problem, slot = null) {
let names, planned, tolerance;
tolerance = (truth(problem.tolerance_m) ? `, tolerance_m=${repr(problem.tolerance_m)}` : "");
[names, planned] = iter(["plan_all", `m, *as_fast = plan_all(pose, orbit, uav${str(_wind(problem))}${str(tolerance)})`]);
if (truth(slot)) {
[names, planned] = iter(["Slot, plan", `m = plan(pose, orbit, uav${str(_wind(problem))}, slot=${repr(slot)})`]);
}
return join_("\n", [...iter(_scene_lines(problem, names)), planned, "print(m.word, m.turn.value, m.duration_s)"]);
}

function certify(maneuver, tolerance_m = 0.0) {
let accuracy, formulation, lam, others, problem, psi, start, trajectory;
arrays.unchecked("maneuver", maneuver, Maneuver);
problem = problem_of(maneuver, tolerance_m);
others = _others(maneuver, problem);
trajectory = trajectory_of(maneuver, problem);
accuracy = accuracy_of(trajectory, others);
formulation = (truth(problem.still) ? IN_STILL_AIR : IN_WIND);
lam = null;
psi = null;
if (truth(trajectory.pieces)) {
start = trajectory.first.start;
[lam, psi] = iter([trajectory.lam, [start.psi1, start.psi2]]);
}
return Certificate(maneuver, lam, psi, _choice(trajectory), tuple(switches_of(trajectory)), tuple(residuals(formulation, trajectory, accuracy, others)), others, trajectory.pieces, mul(accuracy.tie, problem.time_unit_s), and(problem.has_closed_form, () => eq(tolerance_m, 0.0)));
}

function certify_slot(maneuver, slot) {
let bounds, first, pieces, problem, start, trajectory, unit_s;
arrays.unchecked("maneuver", maneuver, Maneuver);
arrays.unchecked("slot", slot, Slot);
problem = problem_of(maneuver);
unit_s = problem.time_unit_s;
trajectory = _trajectory(maneuver, problem);
bounds = list(iter(directions(problem.orbit.turn))).map((turn) => _no_arrival(trajectory, problem.with_turn(turn), slot));
first = min(bounds, { key: ((bound) => bound.time) });
pieces = trajectory.pieces;
start = (truth(pieces) ? item(pieces, 0).start : null);
return SlotCertificate(maneuver, (truth(start) ? trajectory.lam : null), (truth(start) ? [start.psi1, start.psi2] : null), slot_certificate__choice(trajectory), tuple(switches_of(trajectory)), tuple(_slot_residuals(trajectory, slot, first)), _other_direction(maneuver, problem, slot), pieces, mul(resolution(trajectory.duration), unit_s), false, slot, mul(first.time, unit_s));
}

const Instant = struct(class extends Tuple {
constructor(time_s, u, phi, psi1, psi2) {
super();
this.time_s = time_s;
this.u = u;
this.phi = phi;
this.psi1 = psi1;
this.psi2 = psi2;

}
}, ["time_s", "u", "phi", "psi1", "psi2"], 'Instant');

function all_fastest(problem) {
return maneuvers(solve_problem(problem, kernel.synthesis_optima, kernel.wind_search_optima));
}

function arrivals(problem, slot) {
let found;
arrays.unchecked("slot", slot, Slot);
if (ne(problem.tolerance_m, 0.0)) {
throw errors.InvalidArgument("tolerance_m", "must be 0 with a slot: its entry ends in the slot");
}
found = sorted(list(iter(directions(problem.orbit.turn))).map((turn) => _arrival(problem, turn, slot)), { key: ((solved) => solved.time) });
return maneuvers(list(iter(found)).map((one) => _with_orbit(one, problem.orbit)));
}

function _planned(placed, asked) {
let leg, problem;
if (((asked.altitude_m != null) && (asked.start_altitude_m == null))) {
throw errors.InvalidArgument("start_altitude_m", "is missing: the climb or descent to the exit begins there");
}
problem = _problem(placed, asked);
leg = Leg(problem.pose, problem.orbit, asked.exit_to, asked.hold_s, asked.turns, asked.altitude_m);
return plan_leg(leg, problem.aircraft, problem.wind);
}

function _problem(placed, asked) {
let pose, problem, rates, uav;
problem = placed.problem;
pose = replace(problem.pose, { altitude_m: asked.start_altitude_m });
rates = [asked.climb_rate_m_s, asked.descent_rate_m_s];
uav = replace(problem.aircraft, { climb_rate_m_s: item(rates, 0), descent_rate_m_s: item(rates, 1) });
return Problem(pose, problem.orbit, uav, problem.wind);
}

function leg_instruction(plan) {
let decimals, first, first_s, hold, later, parts, text;
hold = `hold ${str(Turn_described(plan.turn))}`;
decimals = (ge(plan.leg.orbit.radius_m, 10.0) ? 2 : 3);
parts = list(iter(plan.entry.segments)).map((segment) => [segment.duration_s, item(ACTIONS, segment.letter)]);
parts = add(parts, (gt(plan.held_s, 0.0) ? [[plan.held_s, hold]] : []));
[[first_s, first], ...later] = iter([...iter(parts), [plan.straight_s, "leave straight"]]);
text = `${str(capitalize_(first))} now`;
if (truth(later)) {
text = add(text, `, then ${str(item(item(later, 0), 1))} in ${format(first_s, `.${String(decimals)}f`)} s`);
}
if (gt(plan.held_s, 0.0)) {
text = add(text, `. ${str(capitalize_(hold))} from ${format(plan.entry.duration_s, `.${String(decimals)}f`)} s for ${format(div(plan.held_deg, 360.0), `.2f`)} turns`);
}
return `${str(text)}. Leave in ${format(plan.exit_s, `.${String(decimals)}f`)} s, at the point in ${format(plan.duration_s, `.${String(decimals)}f`)} s.`;
}

function leg_command(problem, leg) {
let numbers, words;
words = [`loiter leg${str(removeprefix_(command(problem), "loiter plan"))}`, _option("exit_to", ...iter(leg.exit_to))];
numbers = new Map([["hold_s", or(leg.hold_s, () => null)], ["turns", or(leg.turns, () => null)], ["start_altitude_m", leg.pose.altitude_m], ["altitude_m", leg.altitude_m], ["climb_rate_m_s", problem.aircraft.climb_rate_m_s], ["descent_rate_m_s", problem.aircraft.descent_rate_m_s]]);
words = add(words, list(iter(items_(numbers))).map((one) => iter(one)).filter(([name, number]) => (number != null)).map(([name, number]) => _option(name, number)));
return join_(" ", words);
}

function leg_python(problem, leg) {
let asked, east_m, lines, needs, north_m;
[east_m, north_m] = iter(leg.exit_to);
needs = (truth(leg.hold_s) ? [`hold_s=${repr(leg.hold_s)}`] : []);
needs = add(needs, (truth(leg.turns) ? [`turns=${repr(leg.turns)}`] : []));
needs = add(needs, ((leg.altitude_m != null) ? [`altitude_m=${repr(leg.altitude_m)}`] : []));
asked = join_(", ", ["pose", "orbit", `exit_to=(${repr(east_m)}, ${repr(north_m)})`, ...iter(needs)]);
lines = [...iter(_scene_lines(problem, "Leg, plan_leg")), `p = plan_leg(Leg(${str(asked)}), uav${str(_wind(problem))})`, "print(p)"];
return join_("\n", lines);
}

function _altitudes(plan) {
let leg, reached_s;
leg = plan.leg;
if (((leg.altitude_m == null) || (leg.pose.altitude_m == null))) {
return null;
}
reached_s = climb_time_s(leg, plan.entry.aircraft);
return new Map([["time_s", [0.0, reached_s, plan.duration_s]], ["altitude_m", [leg.pose.altitude_m, leg.altitude_m, leg.altitude_m]]]);
}

function _whole(plan, placed) {
let after, entry, hold, leave, whole;
entry = maneuver_values(plan.entry, placed.frame);
hold = legs__segment("hold", item(HOLD_LETTERS, plan.turn), plan.entry.duration_s, plan.held_s);
hold = bit_or(hold, new Map([["start", pose_values(plan.entry.join)], ["end", pose_values(plan.exit)]]));
leave = legs__segment("leave", "S", plan.exit_s, plan.straight_s);
leave = bit_or(leave, new Map([["start", pose_values(plan.exit)], ["end", pose_values(plan.end)]]));
after = list(iter([hold, leave])).filter((segment) => gt(item(segment, "duration_s"), 0.0)).map((segment) => segment);
whole = new Map([["duration_s", plan.duration_s], ["join_s", plan.entry.duration_s], ["length_m", mul(plan.duration_s, plan.entry.aircraft.airspeed_m_s)], ["segments", [...iter(item(entry, "segments")), ...iter(after)]], ["track", legs__track(plan)]]);
return bit_or(entry, whole);
}

function check(fence, maneuver, margin_m = null) {
arrays.unchecked("fence", fence, Fence);
return fence.check(maneuver, margin_m);
}

function leg_text(plan, ending, frame, autopilot, fence = null) {
let found;
if (eq(ending, ".kml")) {
arrays.unchecked("frame", frame, LocalFrame);
return leg_kml(plan, frame);
}
if ((ne(ending, ".plan") && eq(autopilot, Autopilot.PX4))) {
throw errors.InvalidArgument("autopilot", `is px4, which takes no ${str(ending)} file: write a .plan file for PX4`);
}
found = leg_mission(plan, frame, autopilot);
if (ne(ending, ".plan")) {
return wpl(found);
}
return qgcplan(found, autopilot, plan.entry.aircraft.airspeed_m_s, fence);
}

function _search(placed, fence, margin_m) {
let problem;
problem = placed.problem;
return fastest_clear(fence, problem.pose, problem.orbit, problem.aircraft, problem.wind, margin_m);
}

function maneuver_values(maneuver, frame = null) {
return maneuver_maneuver_values(maneuver, ((frame != null) ? partial(_placed_values, frame) : pose_values));
}

function _checked_corner(where, corner) {
let east, north;
if (ne(len(corner), 2)) {
throw errors.InvalidArgument(where, "has a corner that is not two numbers, east and north");
}
[east, north] = iter(list(iter(corner)).map((value) => number(`${str(where)} corner`, value, "metres")));
return [east, north];
}

function _differ(corner, other) {
return gt(math.dist(corner, other), SAME_CORNER_M);
}

function edges_of(polygons) {
let ax, ay, bx, by, counts, ends, first, starts;
starts = list(iter(polygons)).flatMap((zone) => list(iter(zone.corners)).map((corner) => corner));
ends = list(iter(polygons)).flatMap((zone) => list(iter([...iter(sliced(zone.corners, 1, null, null)), item(zone.corners, 0)])).map((corner) => corner));
counts = list(iter(polygons)).map((zone) => len(zone.corners));
[[ax, ay], [bx, by]] = iter(list(iter([starts, ends])).map((places) => np.array(places, float).reshape(-1, 2).T));
first = sliced(np.cumsum([0, ...iter(counts)]), null, -1, null).astype(np.intp);
return Edges(ax, ay, bx, by, first, np.repeat(np.arange(len(counts)), counts));
}

const LegPlan = struct(class extends Values {
constructor(leg, entry, held_s, held_deg, exit, straight_s) {
super();
this.leg = leg;
this.entry = entry;
this.held_s = held_s;
this.held_deg = held_deg;
this.exit = exit;
this.straight_s = straight_s;

}
get turn() {
const self = this;
return self.entry.turn;
}
get exit_s() {
const self = this;
return add(self.entry.duration_s, self.held_s);
}
get duration_s() {
const self = this;
return add(self.exit_s, self.straight_s);
}
get end() {
let east_m, north_m;
const self = this;
[east_m, north_m] = iter(self.leg.exit_to);
return Pose(east_m, north_m, self.exit.heading_deg);
}
sample(step_s) {
let _, east_m, entry, held, held_s, north_m, on_circle, out, parts, shares, steps, time_s;
const self = this;

entry = self.entry.sample(step_s);
steps = [max(math.ceil(div(self.held_s, step_s)), 1), max(math.ceil(div(self.straight_s, step_s)), 1)];
if (gt(sum(steps), MAX_SAMPLES)) {
throw errors.InvalidArgument("step_s", `is ${str(step_s)}: it would take more than ${MAX_SAMPLES} samples`);
}
[held, shares] = iter(list(iter(steps)).map((n) => sliced(np.linspace(0.0, 1.0, add(n, 1)), 1, null, null)));
[held_s, on_circle, _] = with_middle(self.on_circle(tolist_(held)), 1, 1);
out = [add(self.exit.east_m, mul(sub(self.end.east_m, self.exit.east_m), shares)), add(self.exit.north_m, mul(sub(self.end.north_m, self.exit.north_m), shares))];
time_s = np.concatenate([entry.time_s, held_s, add(self.exit_s, mul(self.straight_s, shares))]);
parts = zip([entry.east_m, entry.north_m], on_circle, out);
[east_m, north_m] = iter(list(iter(parts)).map((part) => np.concatenate(part)));
return Track(time_s, east_m, north_m, self._altitudes(time_s));
}
on_circle(shares) {
let east_m, north_m, rows_, time_s;
const self = this;

rows_ = list(iter(hold_states(self, shares))).map((at) => [at.time_s, at.east_m, at.north_m]);
[time_s, east_m, north_m] = iter(np.array(rows_).reshape(-1, 3).T);
return Track(time_s, east_m, north_m, self._altitudes(time_s));
}
_altitudes(time_s) {
let climb_s, leg, shares;
const self = this;

[leg, climb_s] = iter([self.leg, climb_time_s(self.leg, self.entry.aircraft)]);
if (((leg.altitude_m == null) || (leg.pose.altitude_m == null))) {
return np.full_like(time_s, math.nan);
}
shares = (gt(climb_s, 0.0) ? np.minimum(div(time_s, climb_s), 1.0) : np.ones_like(time_s));
return add(leg.pose.altitude_m, mul(leg.climb_m, shares));
}
to_dict() {
let east_m, north_m;
const self = this;
[east_m, north_m] = iter(self.leg.exit_to);
return new Map([["duration_s", self.duration_s], ["turn", self.turn], ["entry", maneuver_maneuver_values(self.entry)], ["join_s", self.entry.duration_s], ["held_s", self.held_s], ["held_deg", self.held_deg], ["exit_s", self.exit_s], ["exit", pose_values(self.exit)], ["straight_s", self.straight_s], ["exit_to", new Map([["east_m", east_m], ["north_m", north_m]])], ["altitude_m", self.leg.altitude_m]]);
}
toString() {
let digits, entry;
const self = this;
digits = decimals_of(self.leg.orbit);
entry = `${str(or(self.entry.word, () => "on the circle already"))}, ${str(Turn_described(self.turn))}`;
return `${str(entry)}: joins in ${format(self.entry.duration_s, `.${String(digits)}f`)} s, holds for ${format(self.held_s, `.${String(digits)}f`)} s (${format(div(self.held_deg, 360.0), `.2f`)} turns), is at the point after ${format(self.duration_s, `.${String(digits)}f`)} s`;
}
}, ["leg", "entry", "held_s", "held_deg", "exit", "straight_s"], 'LegPlan');

function default_margin_m(orbit) {
arrays.unchecked("orbit", orbit, Orbit);
return max(LEAST_MARGIN_M, mul(MARGIN_SHARE, orbit.radius_m));
}

function flown_path(flown) {
let maneuver, rows_;
maneuver = (truth(isinstance(flown, LegPlan)) ? flown.entry : flown);
rows_ = list(iter(maneuver.segments)).map((segment) => _segment_row(segment, maneuver));
append_(rows_, (truth(maneuver.orbit.moves) ? _moving_hold_row(maneuver) : _hold_row(maneuver)));
if (truth(isinstance(flown, LegPlan))) {
append_(rows_, _way_out_row(flown));
}
return FlownPath(Pieces(...iter(np.array(rows_, float).T)), len(maneuver.segments), maneuver.duration_s);
}

function _check_start(fence, start) {
let distance_m, distances, zone, zones;
for ([zones, distances] of rows(zip(_by_kind(fence), fence.signed_distances(start.east_m, start.north_m)))) {
for ([zone, distance_m] of rows(zip(zones, tolist_(distances)))) {
if (lt(distance_m, neg(TOUCH_M))) {
throw errors.InvalidArgument("pose", _wrong_side(zone));
}
}
}
}

function _by_kind(fence) {
return [fence.polygons, fence.circle_zones];
}

function approach(fence, pieces, margin_m) {
let bent, circles, j, parts, polygons, zones;
[polygons, circles] = iter([Closest.none(len(fence.polygons)), Closest.none(len(fence.circle_zones))]);
bent = item(pieces.bent.nonzero(), 0);
if (truth(fence.polygons)) {
if (truth(bent.size)) {
_note_arcs_to_edges(polygons, pieces, bent, fence.edges);
}
[parts, j] = iter(_near_edges(polygons, pieces, fence.edges, margin_m));
search__search(polygons, pieces, parts, j, _edge_bounds, fence.edges, fence.edges.zone, margin_m, true);
}
if (truth(fence.circle_zones)) {
if (truth(bent.size)) {
_note_arcs_to_circles(circles, pieces, bent, fence.circles);
}
zones = np.arange(len(fence.circle_zones));
[parts, j] = iter(_pairs(first_parts(pieces, item(invert(pieces.bent).nonzero(), 0)), zones.size));
search__search(circles, pieces, parts, j, _circle_bounds, fence.circles, zones, margin_m, false);
}
return [polygons, circles];
}

const PlaceInPath = struct(class extends Tuple {
constructor(distance, piece, time_s) {
super();
this.distance = distance;
this.piece = piece;
this.time_s = time_s;

}
}, ["distance", "piece", "time_s"], 'PlaceInPath');

function _breach(zone, near, path, maneuver) {
let deepest, entry, place;
if (gt(near.distance, TOUCH_M)) {
return _at(zone, near.distance, near, path, maneuver);
}
entry = first_entry(path.pieces, zone);
deepest = (truth(isinstance(zone, CircleZone)) ? near : least_distance(path.pieces, zone));
place = (le(entry.distance, TOUCH_M) ? entry : deepest);
return _at(zone, deepest.distance, place, path, maneuver);
}

function _at(zone, clearance_m, place, path, maneuver) {
let flown_rad, holding, pieces, time_s, x, y;
pieces = path.pieces;
[x, y] = iter(pieces.take(place.piece).position(place.time_s));
holding = eq(place.piece, path.hold);
time_s = add(float(item(pieces.start_s, place.piece)), place.time_s);
if ((truth(holding) && !truth(maneuver.orbit.moves))) {
flown_rad = float(div(mul(place.time_s, item(pieces.speed, place.piece)), item(pieces.radius, place.piece)));
time_s = add(path.hold_s, time_in_hold(maneuver, flown_rad));
}
return Breach(zone, clearance_m, float(x), float(y), time_s, holding);
}

const FenceCheck = struct(class extends Tuple {
constructor(margin_m, closest, breaches, decimals = 1) {
super();
this.margin_m = margin_m;
this.closest = closest;
this.breaches = breaches;
this.decimals = decimals;

}
get clear() {
const self = this;
return !truth(self.breaches);
}
get clearance_m() {
const self = this;
return self.closest.clearance_m;
}
sentence(frame = null) {
const self = this;
return (truth(self.clear) ? _clear_sentence(self, frame) : _breach_sentence(self, frame));
}
to_dict(frame = null) {
const self = this;
return new Map([["clear", self.clear], ["margin_m", self.margin_m], ["closest", _values(self.closest, frame)], ["breaches", list(iter(self.breaches)).map((breach) => _values(breach, frame))]]);
}
}, ["margin_m", "closest", "breaches", "decimals"], 'FenceCheck');

function _check_common_point(inclusions) {
let i, names, other, zone;
for ([i, zone] of rows(enumerate(inclusions))) {
for (other of iter(sliced(inclusions, add(i, 1), null, null))) {
if (gt(shapes.gap_m(zone, other), 0.0)) {
names = `${repr(zone.name)} and ${repr(other.name)}`;
throw errors.InvalidArgument("fence", `has the inclusion zones ${str(names)} with no common point to fly in`);
}
}
}
}

const Circles = struct(class extends Tuple {
constructor(x, y, radius, sign) {
super();
this.x = x;
this.y = y;
this.radius = radius;
this.sign = sign;

}
}, ["x", "y", "radius", "sign"], 'Circles');

function to_edge(x, y, edges) {
let ex, ey, px, py, share;
[ex, ey] = iter([sub(edges.bx, edges.ax), sub(edges.by, edges.ay)]);
[px, py] = iter([sub(x, edges.ax), sub(y, edges.ay)]);
share = np.clip(div(add(mul(px, ex), mul(py, ey)), add(mul(ex, ex), mul(ey, ey))), 0.0, 1.0);
return np.hypot(sub(px, mul(share, ex)), sub(py, mul(share, ey)));
}

function flown_from(start, u, length_m, aircraft, wind, radius_m = null) {
radius_m = ((radius_m == null) ? aircraft.turn_radius_m : radius_m);
return Pose(...iter(_flown(start, u, length_m, radius_m, aircraft, wind, kernel.fly)));
}

const ReducedProblem = struct(class extends Tuple {
constructor(x, y, R, side, tolerance) {
super();
this.x = x;
this.y = y;
this.R = R;
this.side = side;
this.tolerance = tolerance;

}
}, ["x", "y", "R", "side", "tolerance"], 'ReducedProblem');

function too_tight(orbit, aircraft) {
let V, limit, need, needed, r, rate;
[r, V, needed] = iter([aircraft.turn_radius_m, aircraft.airspeed_m_s, aircraft.bank_deg(orbit.radius_m)]);
if ((aircraft.max_bank_deg != null)) {
[limit, need] = iter([` and ${format(aircraft.max_bank_deg, `.4g`)} deg of bank`, `${format(needed, `.4g`)} deg`]);
} else {
if ((aircraft.max_turn_rate_deg_s != null)) {
rate = div(mul(aircraft.max_turn_rate_deg_s, r), orbit.radius_m);
[limit, need] = iter([` and ${format(aircraft.max_turn_rate_deg_s, `.4g`)} deg/s`, `${format(rate, `.4g`)} deg/s (${format(needed, `.4g`)} deg of bank)`]);
} else {
[limit, need] = iter(["", `${format(needed, `.4g`)} deg of bank`]);
}
}
return `orbit radius ${format(orbit.radius_m, `g`)} m is tighter than the aircraft can turn: ${format(r, `.4g`)} m at ${format(V, `.4g`)} m/s${str(limit)}; it needs ${str(need)}`;
}

function check_held(orbit, aircraft, air, wind = null) {
let V, sentence, speed, status, tightest;
status = _status(orbit, aircraft, air);
if (eq(status, kernel.Status.WIND_TOO_STRONG)) {
[V, speed] = iter([aircraft.airspeed_m_s, mul(math.hypot(...iter(air)), aircraft.airspeed_m_s)]);
throw errors.WindTooStrong(`in ${str(_air(orbit, speed))} an aircraft of ${format(V, `.4g`)} m/s can hold no circle: its airspeed must be above ${format(speed, `.4g`)} m/s${str(_swapped_hint(orbit, aircraft, wind))}`);
}
if (has(status, [kernel.Status.NOT_HELD, kernel.Status.RADIUS_TOO_SMALL])) {
tightest = kernel.tightest_radius(...iter(air));
sentence = (truth(air.still) ? too_tight(orbit, aircraft) : _not_held(orbit, aircraft, air, tightest));
throw errors.RadiusTooSmall(sentence, mul(tightest, aircraft.turn_radius_m));
}
}

const WindProblem = struct(class extends Tuple {
constructor(x, y, c, s, R, side, wx, wy, tolerance = 0.0) {
super();
this.x = x;
this.y = y;
this.c = c;
this.s = s;
this.R = R;
this.side = side;
this.wx = wx;
this.wy = wy;
this.tolerance = tolerance;

}
}, ["x", "y", "c", "s", "R", "side", "wx", "wy", "tolerance"], 'WindProblem');

function phase_at_start(slot, problem, time_unit_s) {
let R, period, phase, side, time, wx, wy;
[side, R, wx, wy] = iter([problem.side, problem.R, problem.wx, problem.wy]);
phase = kernel.phase_of(...iter(heading_vector(slot.phase_deg)), side, wx, wy);
period = kernel.time_held(add(phase, TWO_PI), TWO_PI, R, wx, wy);
time = div(slot.at_s, time_unit_s);
if ((!truth(math.isfinite(time)) || gt(abs(time), mul(MOST_TURNS, period)))) {
throw errors.OutOfRange(`the slot is given at ${format(slot.at_s, `g`)} s: more than ${format(MOST_TURNS, `g`)} turns lie between the start and then`);
}
return sub(phase, kernel.width_held(phase, mod(math.fmod(time, period), period), R, wx, wy));
}

function drawing__track(segment, aircraft, wind) {
let _, east, north, points;

points = (eq(segment.letter, "S") ? 2 : ARC_POINTS);
[east, north, _] = iter(along(segment, np.linspace(0.0, segment.length_m, points), aircraft, wind));
return list(zip(tolist_(east), tolist_(north)));
}

function _view_of(points) {
let east, height, margin, north, pixels, scale, width;
[east, north] = iter(zip(...iter(points)));
[width, height] = iter([sub(max(east), min(east)), sub(max(north), min(north))]);
margin = mul(MARGIN, max(width, height));
pixels = mul(WIDTH, min(max(div(add(height, mul(2, margin)), add(width, mul(2, margin))), FLATTEST), STEEPEST));
scale = min(div(WIDTH, add(width, mul(2, margin))), div(pixels, add(height, mul(2, margin))));
return _View(mul(0.5, add(max(east), min(east))), mul(0.5, add(max(north), min(north))), scale, pixels);
}

function _direction(view, circle, turn, quarter) {
let azimuth, east, north, outline, place, turned;
azimuth = add(45.0, mul(90.0, quarter));
[east, north] = iter(heading_vector(azimuth));
place = view.pixels(add(circle.east_m, mul(circle.radius_m, east)), add(circle.north_m, mul(circle.radius_m, north)));
turned = add(azimuth, (eq(turn, Turn.CW) ? 90.0 : -90.0));
outline = `0,${str(neg(ARROW))} ${str(mul(0.7, ARROW))},${str(mul(0.6, ARROW))} ${str(mul(-0.7, ARROW))},${str(mul(0.6, ARROW))}`;
return `<polygon points="${str(outline)}" transform="translate(${str(place)}) rotate(${format(turned, `.1f`)})" fill="black"/>`;
}

function drawing__line(view, letter, track) {
let points;
points = join_(" ", list(iter(track)).map((point) => view.pixels(...iter(point))));
return `<polyline points="${str(points)}" fill="none" stroke="${str(item(COLOURS, letter))}" stroke-width="${str(THICK)}" stroke-linejoin="round"/>`;
}

function _dot(view, pose, fill) {
let x, y;
[x, y] = iter(view.pixels(pose.east_m, pose.north_m).split(","));
return `<circle cx="${str(x)}" cy="${str(y)}" r="${str(drawing_MARK)}" fill="${str(fill)}" stroke="black"/>`;
}

function _aircraft(view, pose) {
let outline, place, size, turned;
turned = math.degrees(math.atan2(...iter(heading_vector(pose.heading_deg))));
place = view.pixels(pose.east_m, pose.north_m);
size = mul(0.5, AIRCRAFT);
outline = `0,${str(neg(size))} ${str(mul(0.6, size))},${str(mul(0.7, size))} 0,${str(mul(0.35, size))} ${str(mul(-0.6, size))},${str(mul(0.7, size))}`;
return `<polygon points="${str(outline)}" transform="translate(${str(place)}) rotate(${format(turned, `.1f`)})" fill="black"/>`;
}

function solve_problem(problem, in_still_air, in_wind) {
let R, _, found, reduced, x, y;
if (truth(problem.has_closed_form)) {
reduced = problem.reduced();
[x, y, R, _, _] = iter(reduced);
return tuple(list(iter(in_still_air(...iter(reduced)))).map((entry) => Solved(maneuver(problem, entry, kernel.miss(x, y, R, entry)), kernel.entry_duration(entry))));
}
found = in_wind(problem.in_wind());
if ((!truth(found) || ne(item(found, 0).status, kernel.Status.OK))) {
throw _not_converged(problem);
}
return tuple(list(iter(found)).map((entry) => Solved(maneuver(problem, kernel.entry_of(entry), entry.miss), kernel.time_of(entry))));
}

function _tied(known, problem) {
let R, allowed, least, turn;
[turn, R] = iter([problem.orbit.turn, problem.radius]);
allowed = list(iter(known)).filter((one) => has(turn, [Turn.EITHER, one.maneuver.turn])).map((one) => _with_orbit(one, problem.orbit));
least = min(list(iter(allowed)).map((candidate) => candidate.time));
return maneuvers(list(iter(allowed)).filter((candidate) => truth(kernel.is_tie_in_wind(candidate.time, least, R))).map((candidate) => candidate));
}

function maneuvers(found) {
return tuple(list(iter(found)).map((candidate) => candidate.maneuver));
}

function _given_limit(aircraft) {
return next(list(iter(TURN_LIMITS)).filter((name) => (aircraft[name] != null)).map((name) => name));
}

function _option(argument, ...numbers) {
return join_(" ", [item(OPTIONS, argument), ...iter(list(iter(numbers)).map((number) => removesuffix_(repr(number), ".0")))]);
}

function _wind(problem) {
return (ne(problem.wind, CALM) ? `, ${repr(problem.wind)}` : "");
}

function _scene_lines(problem, names) {
let given, imported, limit, uav, values;
uav = problem.aircraft;
limit = _given_limit(uav);
given = list(iter([limit, "climb_rate_m_s", "descent_rate_m_s"])).filter((name) => (uav[name] != null)).map((name) => name);
values = join_(", ", list(iter(["airspeed_m_s", ...iter(given)])).map((name) => `${str(name)}=${repr(uav[name])}`));
imported = join_(", ", ["Aircraft", "Orbit", "Pose", ...iter((truth(_wind(problem)) ? ["Wind"] : [])), names]);
return [`from loiter import ${str(imported)}`, "", `pose = ${repr(problem.pose)}`, `orbit = ${str(_orbit(problem.orbit))}`, `uav = Aircraft(${str(values)})`];
}

function problem_of(maneuver, tolerance_m = 0.0) {
return Problem(maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind, tolerance_m);
}

function _others(maneuver, problem) {
return tuple(list(iter(extremals(problem))).filter((other) => ne([other.turn, other.segments], [maneuver.turn, maneuver.segments])).map((other) => Candidate(other.word, other.turn, other.duration_s, sub(other.duration_s, maneuver.duration_s))));
}

function trajectory_of(maneuver, problem) {
let controls, durations, flown, plans, start;
start = _start(problem, sign_of(held_turn(maneuver)));
[controls, durations] = iter([list(iter(letters(arrays.word_of(maneuver)))).map((letter) => item(CONTROLS, letter)), durations_of(maneuver)]);
if (!truth(controls)) {
return Trajectory(maneuver, problem, start, 1.0, []);
}
plans = (truth(problem.has_closed_form) ? _in_still_air : _in_wind)(start, controls, durations);
flown = list(iter(plans)).map((plan) => Trajectory(maneuver, problem, plan.start, plan.adjoint.lam, tuple(flown_pieces(...iter(plan)))));
return min(flown, { key: ((trajectory) => trajectory.worst_violation) });
}

function accuracy_of(trajectory, others) {
return (truth(trajectory.problem.has_closed_form) ? accuracy__in_still_air(trajectory, others) : accuracy_in_wind(trajectory));
}

function target(trajectory, accuracy) {
return Violation(trajectory.miss, accuracy.end);
}

function join(trajectory, accuracy) {
let last, maneuver, start;
[maneuver, start] = iter([trajectory.maneuver, trajectory.start]);
last = replace(trajectory.problem, { pose: maneuver.join, orbit: maneuver.orbit_at_join, wind: CALM }).reduced();
return Violation(math.hypot(last.x, sub(last.y, mul(start.side, start.R))), accuracy.join);
}

function turn(trajectory, accuracy) {
let maneuver;
maneuver = trajectory.maneuver;
return Violation(float(!has(maneuver.orbit.turn, [maneuver.turn, Turn.EITHER])), 0.0);
}

function switch_(trajectory, accuracy) {
let off, starts;
starts = list(iter(trajectory.opposed)).map((piece) => piece.start);
off = max(list(iter(starts)).map((start) => math.hypot(start.phi, sub(start.psi1, trajectory.lam))), { default: null });
return ((off == null) ? null : Violation(off, accuracy.angle));
}

function middle_arc(trajectory, accuracy) {
let last, lasts, middle;
if (ne(len(trajectory.opposed), 2)) {
return null;
}
[middle, last] = iter(trajectory.opposed);
lasts = mul(2.0, sub(math.pi, math.atan2(abs(last.start.psi2), last.start.psi1)));
return Violation(max(abs(sub(middle.t, lasts)), sub(math.pi, middle.t)), mul(2.0, accuracy.angle));
}

function slopes(trajectory, accuracy) {
let a, b, ra, rb;
if (ne(len(trajectory.opposed), 2)) {
return null;
}
[a, b] = iter(list(iter(trajectory.opposed)).map((piece) => piece.start));
[ra, rb] = iter([abs(a.reduced), abs(b.reduced)]);
return Violation(abs(add(mul(a.x, b.y), mul(b.x, a.y))), add(mul(accuracy.end, add(ra, rb)), mul(mul(accuracy.angle, ra), rb)));
}

function line(trajectory, accuracy) {
let off;
off = max(list(iter(trajectory.pieces)).filter((piece) => eq(piece.u, 0)).map((piece) => abs(piece.start.y)), { default: null });
return ((off == null) ? null : Violation(off, accuracy.end));
}

function axis(trajectory, accuracy) {
let arcs;
if (ne(trajectory.problem.orbit.turn, Turn.EITHER)) {
return null;
}
arcs = list(iter(trajectory.pieces)).filter((piece) => truth(piece.u)).map((piece) => piece);
return Violation(max(list(iter(arcs)).flatMap((arc) => list(iter(_crossings(arc))).map((lost) => lost)), { default: 0.0 }), accuracy.maximum_principle.sign);
}

function last_arc(trajectory, accuracy, tight) {
let R, _, early, free, last, longest, side;
[last, [_, _, _, R, side]] = iter([trajectory.last, trajectory.start]);
free = (eq(trajectory.problem.orbit.turn, Turn.EITHER) && eq(tight, eq(R, 1.0)));
if ((!truth(free) || eq(len(trajectory.pieces), 1) || ne(last.u, side))) {
return null;
}
longest = math.atan2(math.sqrt(mul(R, add(R, 2.0))), 1.0);
early = math.sqrt(mul(2.0, pow(accuracy.length, div(2.0, 3.0))));
return Violation(max(0.0, sub(last.t, longest)), add(accuracy.end, early));
}

const Formulation = struct(class extends Tuple {
constructor(arrival, motion, maximum_principle, further, gradient) {
super();
this.arrival = arrival;
this.motion = motion;
this.maximum_principle = maximum_principle;
this.further = further;
this.gradient = gradient;

}
}, ["arrival", "motion", "maximum_principle", "further", "gradient"], 'Formulation');

const Condition = struct(class extends Tuple {
constructor(name, equation, violation) {
super();
this.name = name;
this.equation = equation;
this.violation = violation;

}
}, ["name", "equation", "violation"], 'Condition');

const EquationOfMotion = struct(class extends Tuple {
constructor(name, equation, quantity, rate) {
super();
this.name = name;
this.equation = equation;
this.quantity = quantity;
this.rate = rate;

}
}, ["name", "equation", "quantity", "rate"], 'EquationOfMotion');

function* _crossings(arc) {
let after, before, bounds, crossings, ends, heights, s;
crossings = list(iter([-1.0, 1.0])).map((end) => kernel.onto_axis(arc.start.x, mul(arc.u, arc.start.y), end, 0.0));
ends = sorted(list(iter(crossings)).map((one) => iter(one)).filter(([rotated, c]) => ge(c, 0.0)).map(([rotated, c]) => kernel.angle(rotated)));
bounds = [0.0, ...iter(list(iter(ends)).filter((s) => lt(s, arc.t)).map((s) => s)), arc.t];
heights = list(iter(pairwise(bounds))).map((one) => iter(one)).map(([a, b]) => abs(arc.at(mul(0.5, add(a, b))).y));
for ([s, [before, after]] of rows(zip(sliced(bounds, 1, null, null), pairwise(heights)))) {
yield mul(abs(arc.at(s).psi2), min(before, after));
}
}

const GradientEquations = struct(class extends Tuple {
constructor(gradient, bellman) {
super();
this.gradient = gradient;
this.bellman = bellman;

}
}, ["gradient", "bellman"], 'GradientEquations');

const Violation = struct(class extends Tuple {
constructor(value, bound) {
super();
this.value = value;
this.bound = bound;

}
}, ["value", "bound"], 'Violation');

function distance_from_circle(trajectory, accuracy) {
let _, q;
[q, _] = iter(trajectory.end);
return Violation(abs(sub(abs(q), trajectory.start.R)), accuracy.end);
}

function course(trajectory, accuracy) {
let e, q;
[q, e] = iter(trajectory.end);
return Violation(div(abs(inner(q, add(e, trajectory.start.w))), max(abs(q), accuracy.end)), mul(2.0, accuracy.end));
}

function conditions_join(trajectory, accuracy) {
let _, circle, from_centre, pose, q;
[pose, circle] = iter([trajectory.maneuver.join, trajectory.maneuver.orbit_at_join]);
from_centre = complex(sub(pose.east_m, circle.east_m), sub(pose.north_m, circle.north_m));
[q, _] = iter(trajectory.end);
return Violation(abs(sub(div(from_centre, trajectory.problem.aircraft.turn_radius_m), q)), accuracy.join);
}

function turn_as_flown(trajectory, accuracy) {
let _, bound, e, excluded, opposite, q, side, w;
[[q, e], [_, _, w, _, side]] = iter([trajectory.end, trajectory.start]);
opposite = gt(mul(inner(mul(new Complex(0.0, 1.0), q), add(e, w)), side), 0.0);
[excluded, bound] = iter(turn(trajectory, accuracy));
return Violation(max(excluded, float(opposite)), bound);
}

function inner(a, b) {
return mul(conjugate_(a), b).real;
}

const Certificate = struct(class extends Values {
constructor(maneuver, lam, psi, choice, switches, residuals, others, pieces, tie_s, complete) {
super();
this.maneuver = maneuver;
this.lam = lam;
this.psi = psi;
this.choice = choice;
this.switches = switches;
this.residuals = residuals;
this.others = others;
this.pieces = pieces;
this.tie_s = tie_s;
this.complete = complete;

}
get proved_optimal() {
const self = this;
return and(self.complete, () => self.valid);
}
get rounding() {
const self = this;
return rounding_bound(self.maneuver, problem_of(self.maneuver), self.proved_optimal);
}
get basis() {
const self = this;
if (!truth(self.valid)) {
return BASIS_VIOLATED;
}
return (truth(self.proved_optimal) ? BASIS_THEOREM : BASIS_NECESSARY);
}
get valid() {
const self = this;
return !truth(self.failed);
}
get failed() {
const self = this;
return tuple(list(iter(self.residuals)).filter((residual) => truth(residual.failed)).map((residual) => residual));
}
get runner_up() {
const self = this;
if (truth(any(list(iter(self.others)).map((other) => lt(other.later_s, neg(self.tie_s)))))) {
return null;
}
return next(list(iter(self.others)).filter((other) => gt(other.later_s, self.tie_s)).map((other) => other), null);
}
get margin_s() {
const self = this;
return ((self.runner_up == null) ? null : self.runner_up.later_s);
}
*history(steps = 100) {
let began, piece, times, unit_s;
const self = this;
unit_s = problem_of(self.maneuver).time_unit_s;
began = 0.0;
for (piece of iter(self.pieces)) {
times = list(iter(range(add(steps, 1)))).map((i) => div(mul(piece.t, i), steps));
yield list(iter(times)).map((s) => _instant(piece, began, s, unit_s));
began = add(began, piece.t);
}
}
to_dict() {
const self = this;
return certificate_values(self);
}
}, ["maneuver", "lam", "psi", "choice", "switches", "residuals", "others", "pieces", "tie_s", "complete"], 'Certificate');

function _choice(trajectory) {
let arc, single;
if (!truth(trajectory.pieces)) {
return ON_THE_CIRCLE;
}
single = eq(len(trajectory.pieces), 1);
if (!truth(trajectory.problem.still)) {
return (truth(single) ? ARC_IN_WIND : UNIQUE_IN_WIND);
}
if (!truth(single)) {
return UNIQUE;
}
arc = (eq(len(trajectory.maneuver.segments), 1) ? "a single arc" : ARC_BY_ROUNDING);
return `${str(arc)} has many psi: this is ${str((eq(trajectory.lam, 1.0) ? STRAIGHT_ENTRY : SWITCH_AT_START))}`;
}

function* switches_of(trajectory) {
let after, before, letters_, there, time;
time = 0.0;
for ([before, after] of rows(pairwise(trajectory.pieces))) {
time = add(time, before.t);
there = after.start;
letters_ = add(item(LETTERS, before.u), item(LETTERS, after.u));
yield Switch(mul(time, trajectory.problem.time_unit_s), letters_, there.x, there.y, there.psi1, there.psi2);
}
}

function* residuals(formulation, trajectory, accuracy, others) {
let bound, equation, name, off;
yield* iter(_check(formulation.arrival, trajectory, accuracy));
if (truth(trajectory.pieces)) {
yield* iter(motion_residuals(formulation.motion, trajectory, accuracy));
for ([name, equation] of rows(items_(formulation.maximum_principle))) {
[off, bound] = iter([trajectory.violations[name], accuracy.maximum_principle[name]]);
yield Residual(name, equation, off, bound);
}
yield* iter(_check(formulation.further, trajectory, accuracy));
yield* iter(gradient_residuals(formulation.gradient, trajectory, accuracy));
}
yield _comparison(trajectory, accuracy, others);
}

function _trajectory(maneuver, problem) {
let controls, durations, flown, start;
start = start_in_wind(problem, sign_of(held_turn(maneuver)));
[controls, durations] = iter([list(iter(letters(arrays.word_of(maneuver)))).map((letter) => item(CONTROLS, letter)), durations_of(maneuver)]);
if (!truth(controls)) {
return Trajectory(maneuver, problem, start, 1.0, []);
}
flown = list(iter(_adjoints(start, controls, durations))).map((adjoint) => Trajectory(maneuver, problem, start, adjoint.lam, tuple(flown_pieces(start, controls, durations, adjoint))));
return min(flown, { key: ((one) => max(one.violations.sign, one.violations.hamiltonian)) });
}

function directions(turn) {
return ((turn == Turn.EITHER) ? [Turn.CW, Turn.CCW] : [turn]);
}

function _no_arrival(trajectory, problem, slot) {
let circle;
circle = _held_circle(trajectory, problem, slot);
return no_arrival_before(trajectory.start.q, trajectory.start.e, circle, trajectory.duration);
}

const SlotCertificate = struct(class extends Values {
constructor(maneuver, lam, psi, choice, switches, residuals, others, pieces, tie_s, complete, slot = HERE, clear_s = 0.0) {
super();
this.maneuver = maneuver;
this.lam = lam;
this.psi = psi;
this.choice = choice;
this.switches = switches;
this.residuals = residuals;
this.others = others;
this.pieces = pieces;
this.tie_s = tie_s;
this.complete = complete;
this.slot = slot;
this.clear_s = clear_s;

}
get basis() {
const self = this;
return (truth(self.valid) ? BASIS_SLOT : BASIS_VIOLATED);
}
to_dict() {
const self = this;
return new Map([...iter_items(certificate_values(self)), ["slot", new Map([["phase_deg", self.slot.phase_deg], ["at_s", self.slot.at_s]])], ["no_arrival_before_s", self.clear_s]]);
}
get proved_optimal() {
const self = this;
return and(self.complete, () => self.valid);
}
get rounding() {
const self = this;
return rounding_bound(self.maneuver, problem_of(self.maneuver), self.proved_optimal);
}
get valid() {
const self = this;
return !truth(self.failed);
}
get failed() {
const self = this;
return tuple(list(iter(self.residuals)).filter((residual) => truth(residual.failed)).map((residual) => residual));
}
get runner_up() {
const self = this;
if (truth(any(list(iter(self.others)).map((other) => lt(other.later_s, neg(self.tie_s)))))) {
return null;
}
return next(list(iter(self.others)).filter((other) => gt(other.later_s, self.tie_s)).map((other) => other), null);
}
get margin_s() {
const self = this;
return ((self.runner_up == null) ? null : self.runner_up.later_s);
}
*history(steps = 100) {
let began, piece, times, unit_s;
const self = this;
unit_s = problem_of(self.maneuver).time_unit_s;
began = 0.0;
for (piece of iter(self.pieces)) {
times = list(iter(range(add(steps, 1)))).map((i) => div(mul(piece.t, i), steps));
yield list(iter(times)).map((s) => _instant(piece, began, s, unit_s));
began = add(began, piece.t);
}
}
}, ["maneuver", "lam", "psi", "choice", "switches", "residuals", "others", "pieces", "tie_s", "complete", "slot", "clear_s"], 'SlotCertificate');

function slot_certificate__choice(trajectory) {
if (!truth(trajectory.pieces)) {
return STARTS_IN_SLOT;
}
if (truth(any(list(iter(trajectory.pieces)).map((piece) => eq(piece.u, 0))))) {
return LINE;
}
return (eq(len(trajectory.pieces), 3) ? BISECTOR : ANY);
}

function* _slot_residuals(trajectory, given, first) {
let accuracy, behind, bounds, e, end, last, later, note, off, q, slot;
[accuracy, [q, e], slot] = iter([accuracy_in_wind(trajectory), trajectory.end, _slot_at_end(trajectory, given)]);
end = add(accuracy.end, mul(DOUBLE_ROOT, kernel.rounding(abs(trajectory.start.q), trajectory.start.R, trajectory.duration)));
end = add(end, div(mul(mul(2.0, ROUNDING), abs(given.at_s)), trajectory.problem.time_unit_s));
yield Residual("target", "q(T) is the place of the slot at T", abs(sub(q, slot.place)), end);
yield Residual("course", "e(T) is its heading then", abs(sub(e, slot.heading)), end);
yield Residual("join", "the last pose over the ground is where the circle is then", ...iter(conditions_join(trajectory, accuracy)));
yield Residual("turn", "the circle is held as asked for", ...iter(turn(trajectory, accuracy)));
if (truth(trajectory.pieces)) {
yield* iter(motion_residuals(IN_WIND.motion, trajectory, accuracy));
[off, bounds] = iter([trajectory.violations, accuracy.maximum_principle]);
yield Residual("norm", "|p| = 1", off.norm, bounds.norm);
yield Residual("sign", "u = sign f, u = 0 only where f = 0 (4)", off.sign, bounds.sign);
yield Residual("hamiltonian", "|f| + p.e = lambda (4)", off.hamiltonian, bounds.hamiltonian);
last = trajectory.last;
behind = mul(last.end.phi, sub(last.u, slot.control));
yield Residual("slot", "f (u - h k) >= 0 at T (5)", max(0.0, neg(behind)), mul(2.0, bounds.sign));
}
[later, note] = iter([max(sub(trajectory.duration, first.time), 0.0), _passes(trajectory.problem, first)]);
yield Residual("first", "no path arrives before T", later, resolution(trajectory.duration), note);
}

function _other_direction(maneuver, problem, slot) {
return tuple(list(iter(arrivals(problem, slot))).filter((other) => ne(other.turn, maneuver.turn)).map((other) => Candidate(other.word, other.turn, other.duration_s, sub(other.duration_s, maneuver.duration_s))));
}

function resolution(until) {
return float(pow(mul(mul(24.0, REACHED), add(1.0, until)), div(1.0, 3.0)));
}

function _arrival(problem, turn, slot) {
let entry, given;
given = problem.with_turn(turn).in_wind();
entry = kernel.first_in_slot(given, phase_at_start(slot, given, problem.time_unit_s));
if (ne(entry.status, kernel.Status.OK)) {
throw _not_converged(problem);
}
return Solved(maneuver(problem, kernel.entry_of(entry), entry.miss), kernel.time_of(entry));
}

function _with_orbit(candidate, orbit) {
return replace(candidate, { maneuver: replace(candidate.maneuver, { orbit: orbit }) });
}

const Leg = struct(class extends Values {
constructor(pose, orbit, exit_to, hold_s = 0.0, turns = 0.0, altitude_m = null) {
super();
this.pose = pose;
this.orbit = orbit;
this.exit_to = exit_to;
this.hold_s = hold_s;
this.turns = turns;
this.altitude_m = altitude_m;
this.__post_init__();
}
__post_init__() {
const self = this;
arrays.unchecked("pose", self.pose, Pose);
arrays.unchecked("orbit", self.orbit, Orbit);
(self["exit_to"] = _outside(self.exit_to, self.orbit));
(self["hold_s"] = not_negative("hold_s", self.hold_s, "seconds"));
(self["turns"] = not_negative("turns", self.turns, "turns"));
if ((self.altitude_m != null)) {
(self["altitude_m"] = number("altitude_m", self.altitude_m, "metres"));
if ((self.pose.altitude_m == null)) {
throw errors.InvalidArgument("altitude_m", "needs the altitude of the pose: Pose(..., altitude_m=...)");
}
}
}
get climb_m() {
const self = this;
if (((self.altitude_m == null) || (self.pose.altitude_m == null))) {
return 0.0;
}
return sub(self.altitude_m, self.pose.altitude_m);
}
}, ["pose", "orbit", "exit_to", "hold_s", "turns", "altitude_m"], 'Leg');

function plan_leg(leg, aircraft, wind = null) {
let climb_s, problem, turns;
arrays.unchecked("leg", leg, Leg);
problem = Problem(leg.pose, leg.orbit, aircraft, ((wind == null) ? CALM : wind));
climb_s = climb_time_s(leg, aircraft);
turns = directions(leg.orbit.turn);
return min(list(iter(turns)).map((turn) => leg__planned(leg, problem.with_turn(turn), climb_s)), { key: ((plan) => plan.duration_s) });
}

function climb_time_s(leg, aircraft) {
let name, rate, what;
arrays.unchecked("aircraft", aircraft, Aircraft);
if (eq(leg.climb_m, 0.0)) {
return 0.0;
}
name = (gt(leg.climb_m, 0.0) ? "climb_rate_m_s" : "descent_rate_m_s");
rate = aircraft[name];
if ((rate == null)) {
what = (gt(leg.climb_m, 0.0) ? "climbs" : "descends");
throw errors.InvalidArgument(name, `is needed: the leg ${str(what)} by ${format(abs(leg.climb_m), `g`)} m`);
}
return float(div(abs(leg.climb_m), rate));
}

function legs__segment(name, letter, start_s, duration_s) {
return new Map([["name", name], ["letter", letter], ["start_s", start_s], ["duration_s", duration_s]]);
}

function pose_values(pose) {
return new Map([["east_m", pose.east_m], ["north_m", pose.north_m], ["heading_deg", pose.heading_deg]]);
}

function legs__track(plan) {
let after, east, end, entry, heading, last, north, states, time_s, x, y;
[entry, end] = iter([track(plan.entry), plan.end]);
last = HoldState(plan.duration_s, end.east_m, end.north_m, end.heading_deg);
states = [...iter(hold_states(plan, _shares(plan.held_deg))), last];
[time_s, east, north, heading] = iter(list(iter(zip(...iter(states)))).map((column) => list(column)));
[x, y] = iter(arrays.reducer(heading_vector)(np.array(east), np.array(north), np.array(heading), plan.leg.orbit, plan.entry.aircraft));
after = new Map([["time_s", time_s], ["east_m", east], ["north_m", north], ["heading_deg", heading]]);
after = bit_or(after, new Map([["x", tolist_(x)], ["y", tolist_(y)]]));
return new Map(list(iter(entry)).map((name) => [name, [...iter(item(entry, name)), ...iter(item(after, name))]]));
}

function leg_kml(plan, frame) {
let aircraft, at, ends_s, first, has_altitude, i, last, latitude, longitude, mark, mode, name, outermost, places, top, track;
outermost = root("kml", "http://www.opengis.net/kml/2.2");
top = child(outermost, "Document", undefined, new Map([]));
child(top, "name", str(plan), new Map([]));
aircraft = plan.entry.aircraft;
track = plan.sample(div(mul(CHORD_RAD, aircraft.turn_radius_m), aircraft.airspeed_m_s));
[latitude, longitude] = iter(degrees(frame, track.east_m, track.north_m));
has_altitude = bool(np.isfinite(track.altitude_m).all());
mode = (truth(has_altitude) ? "absolute" : "clampToGround");
ends_s = [0.0, plan.entry.duration_s, plan.exit_s, plan.duration_s];
places = list(iter(zip(longitude, latitude, tolist_(track.altitude_m)))).map((one) => iter(one)).map(([lon, lat, altitude]) => add(`${format(lon, `${String(DEGREES)}`)},${format(lat, `${String(DEGREES)}`)}`, (truth(has_altitude) ? `,${format(altitude, `.2f`)}` : "")));
at = list(iter(ends_s)).map((end_s) => int(np.abs(sub(track.time_s, end_s)).argmin()));
add_styles(top, PARTS);
for ([name, first, last] of rows(zip(PARTS, at, sliced(at, 1, null, null)))) {
mark = placemark(top, `${str(name)}: ${format(item(track.time_s, first), `.1f`)} s to ${format(item(track.time_s, last), `.1f`)} s`, name);
add_geometry(mark, "LineString", mode, sliced(places, first, add(last, 1), null));
}
for ([name, i] of rows(zip(["join", "exit", "end"], sliced(at, 1, null, null)))) {
add_geometry(placemark(top, `${str(name)}: ${format(item(track.time_s, i), `.1f`)} s`), "Point", mode, [item(places, i)]);
}
return document(outermost);
}

function leg_mission(plan, frame, autopilot = Autopilot.ARDUPILOT) {
let altitude_m, approach, before, centre, command, end, home, items, middle, orbit, params, point, start;
arrays.unchecked("plan", plan, LegPlan);
arrays.unchecked("frame", frame, LocalFrame);
[altitude_m, orbit] = iter([exit_altitude_m(plan), checked_orbit(plan.leg.orbit)]);
[command, params] = iter(_loiter(plan, autopilot));
params = with_circle(command, params, orbit.radius_m, plan.turn);
approach = approach_waypoints(plan.entry, autopilot);
start = Waypoint(plan.entry.start.east_m, plan.entry.start.north_m);
[centre, point] = iter([Waypoint(orbit.east_m, orbit.north_m), Waypoint(...iter(plan.leg.exit_to))]);
[home, before, middle, end] = with_middle(places_in_degrees(frame, [start, ...iter(approach), centre, point]), 1, 2);
items = [...iter(list(iter(zip(approach, before))).map((one) => iter(one)).map(([w, place]) => _item(MavCommand.NAV_WAYPOINT, [0.0, w.acceptance_m, 0.0, 0.0], place, altitude_m))), _item(command, params, middle, altitude_m), _item(MavCommand.NAV_WAYPOINT, NO_PARAMS, end, altitude_m)];
return Mission(items, [...iter(home), MEAN_SEA_LEVEL.planned_home_m(altitude_m)]);
}

function fastest_clear(fence, pose, orbit, aircraft, wind = null, margin_m = null) {
let problem;
problem = Problem(pose, orbit, aircraft, ((wind == null) ? CALM : wind));
arrays.unchecked("fence", fence, Fence);
return _fastest_clear(fence, problem, checked_margin_m(orbit, margin_m));
}

function maneuver_maneuver_values(maneuver, pose = pose_values) {
return new Map([["duration_s", maneuver.duration_s], ["length_m", maneuver.length_m], ["word", maneuver.word], ["turn", maneuver.turn], ["join", pose(maneuver.join)], ["wind", new Map([["speed_m_s", maneuver.wind.speed_m_s], ["from_deg", maneuver.wind.from_deg]])], ["join_over_ground", _join_over_ground(maneuver)], ["hold", new Map([["least_bank_deg", maneuver.hold.least_bank_deg], ["largest_bank_deg", maneuver.hold.largest_bank_deg], ["largest_bank_azimuth_deg", maneuver.hold.largest_bank_azimuth_deg]])], ["miss_m", maneuver.miss_m], ["segments", list(iter(maneuver.segments)).map((segment) => maneuver__segment(segment, pose))], ["aircraft", new Map([["airspeed_m_s", maneuver.aircraft.airspeed_m_s], ["turn_radius_m", maneuver.aircraft.turn_radius_m]])]]);
}

function _placed_values(frame, pose) {
let place;
place = frame.place(pose);
return bit_or(pose_values(pose), new Map([["latitude_deg", round(place.latitude_deg, places_DECIMALS)], ["longitude_deg", round(place.longitude_deg, places_DECIMALS)], ["true_heading_deg", place.heading_deg]]));
}

const Edges = struct(class extends Tuple {
constructor(ax, ay, bx, by, first, zone) {
super();
this.ax = ax;
this.ay = ay;
this.bx = bx;
this.by = by;
this.first = first;
this.zone = zone;

}
take(i) {
const self = this;
return replace(self, { ax: item(self.ax, i), ay: item(self.ay, i), bx: item(self.bx, i), by: item(self.by, i), zone: item(self.zone, i) });
}
}, ["ax", "ay", "bx", "by", "first", "zone"], 'Edges');

const Track = struct(class extends Tuple {
constructor(time_s, east_m, north_m, altitude_m) {
super();
this.time_s = time_s;
this.east_m = east_m;
this.north_m = north_m;
this.altitude_m = altitude_m;

}
}, ["time_s", "east_m", "north_m", "altitude_m"], 'Track');

function hold_states(plan, shares) {
let R, _, aircraft, c, heading_deg, last, orbit, phase, r, s, share, side, states, time_s, width, wx, wy, x, y;
[orbit, aircraft, r] = iter([plan.leg.orbit, plan.entry.aircraft, plan.entry.aircraft.turn_radius_m]);
[side, R, width] = iter([sign_of(plan.turn), radius_in_turns(orbit, aircraft), math.radians(plan.held_deg)]);
[wx, wy] = iter(relative_wind(orbit, aircraft, plan.entry.wind));
last = kernel.phase_of(sub(plan.exit.east_m, orbit.east_m), sub(plan.exit.north_m, orbit.north_m), side, wx, wy);
states = [];
for (share of iter(shares)) {
phase = sub(last, mul(sub(1.0, share), width));
[x, y, c, s, _] = iter(kernel.hold_pose(phase, side, R, wx, wy));
time_s = add(plan.entry.duration_s, mul(kernel.time_held(phase, mul(share, width), R, wx, wy), div(r, aircraft.airspeed_m_s)));
heading_deg = heading_of(c, s);
append_(states, HoldState(time_s, add(orbit.east_m, mul(r, x)), add(orbit.north_m, mul(r, y)), heading_deg));
}
return states;
}

function _segment_row(segment, maneuver) {
let c, motion, s, start, uav;
[c, s] = iter(heading_vector(segment.start.heading_deg));
[uav, start] = iter([maneuver.aircraft, segment.start]);
motion = [item(CONTROLS, segment.letter), radius_of(segment, uav), uav.airspeed_m_s, ...iter(maneuver.wind.velocity_m_s)];
return [segment.start_s, segment.duration_s, start.east_m, start.north_m, c, s, ...iter(motion), 0.0];
}

function _moving_hold_row(maneuver) {
let R, V, circle, east, motion, north, slowest, speed;
circle = maneuver.orbit_at_join;
[V, R] = iter([maneuver.aircraft.airspeed_m_s, circle.radius_m]);
slowest = mul(V, sub(1.0, math.hypot(...iter(relative_wind(maneuver.orbit, maneuver.aircraft, maneuver.wind)))));
[east, north] = iter([circle.velocity_east_m_s, circle.velocity_north_m_s]);
speed = math.hypot(east, north);
motion = [div(east, speed), div(north, speed), 0.0, R, speed, 0.0, 0.0];
return [maneuver.duration_s, div(mul(mul(2.0, math.pi), R), slowest), circle.east_m, circle.north_m, ...iter(motion), R];
}

function _hold_row(maneuver) {
let R, azimuth, circle, join, nx, ny, place, speed, u;
[circle, join] = iter([maneuver.orbit, maneuver.join]);
azimuth = math.atan2(sub(join.north_m, circle.north_m), sub(join.east_m, circle.east_m));
[u, speed, R] = iter([neg(float(sign_of(maneuver.turn))), maneuver.aircraft.airspeed_m_s, circle.radius_m]);
[nx, ny] = iter([math.cos(azimuth), math.sin(azimuth)]);
place = [add(circle.east_m, mul(R, nx)), add(circle.north_m, mul(R, ny))];
return [maneuver.duration_s, div(mul(mul(2.0, math.pi), R), speed), ...iter(place), mul(neg(u), ny), mul(u, nx), u, R, speed, 0.0, 0.0, 0.0];
}

function _way_out_row(leg) {
let c, motion, place, s, uav;
[c, s] = iter(heading_vector(leg.exit.heading_deg));
[uav, place] = iter([leg.entry.aircraft, [leg.exit.east_m, leg.exit.north_m]]);
motion = [0.0, uav.turn_radius_m, uav.airspeed_m_s, ...iter(leg.entry.wind.velocity_m_s)];
return [leg.exit_s, leg.straight_s, ...iter(place), c, s, ...iter(motion), 0.0];
}

const FlownPath = struct(class extends Tuple {
constructor(pieces, hold, hold_s) {
super();
this.pieces = pieces;
this.hold = hold;
this.hold_s = hold_s;

}
}, ["pieces", "hold", "hold_s"], 'FlownPath');

const Pieces = struct(class extends Tuple {
constructor(start_s, duration_s, x, y, c, s, u, radius, speed, wx, wy, widen) {
super();
this.start_s = start_s;
this.duration_s = duration_s;
this.x = x;
this.y = y;
this.c = c;
this.s = s;
this.u = u;
this.radius = radius;
this.speed = speed;
this.wx = wx;
this.wy = wy;
this.widen = widen;

}
take(i) {
const self = this;
return Pieces(...iter(list(iter(self)).map((column) => item(column, i))));
}
position(time_s) {
let angle, ch, chord, half, sh, x;
const self = this;
angle = div(mul(time_s, self.speed), self.radius);
half = mul(mul(0.5, self.u), angle);
chord = mul(self.radius, np.where(eq(self.u, 0.0), angle, mul(2.0, np.sin(mul(0.5, angle)))));
[ch, sh] = iter([np.cos(half), np.sin(half)]);
x = add(add(self.x, mul(chord, sub(mul(self.c, ch), mul(self.s, sh)))), mul(self.wx, time_s));
return [x, add(add(self.y, mul(chord, add(mul(self.s, ch), mul(self.c, sh)))), mul(self.wy, time_s))];
}
get acceleration() {
const self = this;
return div(mul(abs(self.u), pow(self.speed, 2)), self.radius);
}
get bent() {
const self = this;
return bit_and(bit_and(ne(self.u, 0.0), eq(self.wx, 0.0)), eq(self.wy, 0.0));
}
}, ["start_s", "duration_s", "x", "y", "c", "s", "u", "radius", "speed", "wx", "wy", "widen"], 'Pieces');

function _wrong_side(zone) {
if (truth(zone.inclusion)) {
return `is outside the inclusion zone ${repr(zone.name)}: a plan must begin inside`;
}
return `is inside the zone ${repr(zone.name)}: a plan must begin outside`;
}

const Closest = struct(class extends Tuple {
constructor(distance, piece, time_s) {
super();
this.distance = distance;
this.piece = piece;
this.time_s = time_s;

}
static none(cls, count) {
return cls(np.full(count, np.inf), np.zeros(count, np.intp), np.zeros(count));
}
note(zone, distance, piece, time_s) {
let best;
const self = this;
np.minimum.at(self.distance, zone, distance);
best = eq(distance, item(self.distance, zone));
const unpacked1 = iter([item(piece, best), item(time_s, best)]);
set_item(self.piece, item(zone, best), unpacked1[0]);
set_item(self.time_s, item(zone, best), unpacked1[1]);
}
}, ["distance", "piece", "time_s"], 'Closest');

function _note_arcs_to_edges(closest, pieces, bent, edges) {
let found;
found = arc_to_edge(arcs_of(pieces.take(bent)), edges);
_note(closest, found.distance, found.share, pieces, bent, edges.zone);
}

function _near_edges(closest, pieces, edges, margin_m) {
let at, chords, half, keep, middle, parts, piece, upper, x, y, zone;
parts = first_parts(pieces, item(invert(pieces.bent).nonzero(), 0));
[chords, zone] = iter([Chords.of(pieces, parts), np.broadcast_to(edges.zone, [parts.piece.size, edges.zone.size])]);
[x, y] = iter([mul(0.5, item(add(chords.ax, chords.bx), [slice(null, null), null])), mul(0.5, item(add(chords.ay, chords.by), [slice(null, null), null]))]);
middle = sub(to_edge(x, y, edges), item(chords.widen, [slice(null, null), null]));
half = add(mul(0.5, np.hypot(sub(chords.bx, chords.ax), sub(chords.by, chords.ay))), chords.off);
[upper, at] = iter([add(middle, item(chords.off, [slice(null, null), null])), np.broadcast_to(mul(0.5, item(add(parts.a, parts.b), [slice(null, null), null])), zone.shape)]);
piece = np.broadcast_to(item(parts.piece, [slice(null, null), null]), zone.shape);
closest.note(zone.ravel(), upper.ravel(), piece.ravel(), at.ravel());
keep = _undecided(closest, sub(middle, item(half, [slice(null, null), null])).ravel(), zone.ravel(), margin_m, true);
return [parts.take(floordiv(keep, edges.zone.size)), mod(keep, edges.zone.size)];
}

function search__search(closest, pieces, parts, j, bounds, shapes, zone, margin_m, unsigned) {
let _, found, keep;
for (_ of iter(range(MOST_LEVELS))) {
if (!truth(parts.piece.size)) {
return;
}
found = bounds(shapes, Chords.of(pieces, parts), parts, j);
closest.note(item(zone, j), found.upper, parts.piece, found.at);
keep = _undecided(closest, found.lower, item(zone, j), margin_m, unsigned);
[parts, j] = iter([parts.take(keep).split(), np.repeat(item(j, keep), SPLIT)]);
}
}

function _edge_bounds(edges, chords, parts, j) {
let found;
found = chord_to_edge(chords.ax, chords.ay, chords.bx, chords.by, edges.take(j)).nearest;
return _around(found, chords, parts);
}

function _note_arcs_to_circles(closest, pieces, bent, circles) {
let distance, largest, least, outside;
[least, largest] = iter(arc_to_point(arcs_of(pieces.take(bent)), circles.x, circles.y));
outside = gt(circles.sign, 0.0);
distance = mul(circles.sign, sub(np.where(outside, least.distance, largest.distance), circles.radius));
_note(closest, distance, np.where(outside, least.share, largest.share), pieces, bent, np.arange(circles.x.size));
}

function _pairs(parts, count) {
let n;
n = parts.piece.size;
return [parts.take(np.repeat(np.arange(n), count)), np.tile(np.arange(count), n)];
}

function first_parts(pieces, chosen) {
let angle, counts, k, piece, width;
angle = div(mul(mul(abs(pieces.u), pieces.speed), pieces.duration_s), pieces.radius);
counts = item(np.maximum(1, np.ceil(div(angle, FIRST_PART_RAD))).astype(np.intp), chosen);
piece = np.repeat(chosen, counts);
k = sub(np.arange(piece.size), np.repeat(sub(np.cumsum(counts), counts), counts));
width = div(item(pieces.duration_s, piece), np.repeat(counts, counts));
return Parts(piece, mul(k, width), mul(add(k, 1), width));
}

function _circle_bounds(circles, chords, parts, j) {
let each, far, found, from_a, from_b, near, outside, shift, x, y;
[x, y] = iter([item(circles.x, j), item(circles.y, j)]);
near = chord_to_point(chords.ax, chords.ay, chords.bx, chords.by, x, y);
[from_a, from_b] = iter([np.hypot(sub(chords.ax, x), sub(chords.ay, y)), np.hypot(sub(chords.bx, x), sub(chords.by, y))]);
far = Nearest(neg(np.maximum(from_a, from_b)), np.where(gt(from_a, from_b), 0.0, 1.0));
outside = gt(item(circles.sign, j), 0.0);
each = Nearest(np.where(outside, near.distance, far.distance), np.where(outside, near.share, far.share));
found = _around(each, chords, parts);
shift = mul(item(circles.sign, j), item(circles.radius, j));
return Bounds(sub(found.lower, shift), sub(found.upper, shift), found.at);
}

function first_entry(pieces, zone) {
let entry, searched, simple, until_s;
simple = bit_and(bit_or(eq(pieces.u, 0.0), pieces.bent), eq(pieces.widen, 0.0));
entry = _first_touch(pieces, simple, zone);
until_s = (lt(entry.distance, np.inf) ? add(item(pieces.start_s, entry.piece), entry.time_s) : np.inf);
searched = item(bit_and(invert(simple), lt(pieces.start_s, until_s)).nonzero(), 0);
return (truth(searched.size) ? _searched_entry(pieces, searched, zone, entry, until_s) : entry);
}

function least_distance(pieces, zone) {
let _, best, found, i, parts;
parts = first_parts(pieces, np.arange(pieces.x.size));
best = PlaceInPath(np.inf, 0, 0.0);
for (_ of iter(range(MOST_LEVELS))) {
found = signed_bounds(zone, Chords.of(pieces, parts), parts);
i = int(found.upper.argmin());
if (lt(item(found.upper, i), best.distance)) {
best = PlaceInPath(float(item(found.upper, i)), int(item(parts.piece, i)), float(item(found.at, i)));
}
parts = parts.take(item(lt(found.lower, sub(best.distance, RESOLUTION_M)).nonzero(), 0));
if (!truth(parts.piece.size)) {
break;
}
parts = parts.split();
}
return best;
}

function time_in_hold(maneuver, flown_rad) {
let begin, circle, held, join, side, uav, wx, wy;
[circle, join, uav, side] = iter([maneuver.orbit, maneuver.join, maneuver.aircraft, sign_of(maneuver.turn)]);
[wx, wy] = iter(relative_wind(circle, uav, maneuver.wind));
begin = kernel.phase_of(sub(join.east_m, circle.east_m), sub(join.north_m, circle.north_m), side, wx, wy);
held = kernel.time_held(add(begin, flown_rad), flown_rad, radius_in_turns(circle, uav), wx, wy);
return div(mul(held, uav.turn_radius_m), uav.airspeed_m_s);
}

const Breach = struct(class extends Tuple {
constructor(zone, clearance_m, east_m, north_m, time_s, holding) {
super();
this.zone = zone;
this.clearance_m = clearance_m;
this.east_m = east_m;
this.north_m = north_m;
this.time_s = time_s;
this.holding = holding;

}
get enters() {
const self = this;
return le(self.clearance_m, TOUCH_M);
}
}, ["zone", "clearance_m", "east_m", "north_m", "time_s", "holding"], 'Breach');

function _clear_sentence(found, frame) {
let near, where;
near = found.closest;
where = `at ${str(fence__place(near, frame, found.decimals))}`;
return `The plan and its hold stay clear of the fence, ${format(near.clearance_m, `.${String(found.decimals)}f`)} m from ${str(_named(near.zone))} at least, ${str(where)}.`;
}

function _breach_sentence(found, frame) {
let d, depth, does, first, more, near, others, where;
[first, ...others] = iter(found.breaches);
d = found.decimals;
where = `${str((truth(first.holding) ? "on the circle, " : ""))}in ${format(first.time_s, `.${String(d)}f`)} s, at ${str(fence__place(first, frame, d))}`;
more = (truth(others) ? `; ${str(_and_others(others))}` : "");
if (!truth(first.enters)) {
near = `comes within ${format(first.clearance_m, `.${String(d)}f`)} m of ${str(_named(first.zone))} ${str(where)}`;
return `The plan ${str(near)}, less than the margin of ${format(found.margin_m, `g`)} m${str(more)}.`;
}
does = (truth(first.zone.inclusion) ? "leaves" : "enters");
depth = (lt(first.clearance_m, neg(TOUCH_M)) ? `by up to ${format(max(0.0, neg(first.clearance_m)), `.${String(d)}f`)} m` : "where it touches it");
return `The plan ${str(does)} ${str(_named(first.zone))} ${str(where)}, ${str(depth)}${str(more)}.`;
}

function _values(breach, frame) {
let place, values;
values = new Map([["zone", breach.zone.name], ["inclusion", breach.zone.inclusion], ["clearance_m", breach.clearance_m], ["enters", breach.enters], ["time_s", breach.time_s], ["holding", breach.holding], ["east_m", breach.east_m], ["north_m", breach.north_m]]);
if ((frame == null)) {
return values;
}
place = frame.place(Pose(breach.east_m, breach.north_m, 0.0));
return bit_or(values, new Map([["latitude_deg", place.latitude_deg], ["longitude_deg", place.longitude_deg]]));
}

function _status(orbit, aircraft, air) {
let R;
R = radius_in_turns(orbit, aircraft);
return kernel.wind_search_status_of(WindProblem(0.0, 0.0, 1.0, 0.0, R, kernel.Side.EITHER, ...iter(air)));
}

function _air(orbit, speed) {
return (truth(orbit.moves) ? `air that passes the circle at ${format(speed, `.4g`)} m/s` : `a wind of ${format(speed, `.4g`)} m/s`);
}

function _swapped_hint(orbit, aircraft, wind) {
let from_deg, size, speed, unit;
if (((wind == null) || !(lt(0.0, wind.from_deg) && lt(wind.from_deg, wind.speed_m_s) && le(wind.speed_m_s, 360.0)))) {
return "";
}
[speed, from_deg] = iter([wind.from_deg, wind.speed_m_s]);
for ([unit, size] of rows(items_(new Map([["m/s", 1.0], ["knots", KNOT]])))) {
if (lt(math.hypot(...iter(relative_wind(orbit, aircraft, Wind(mul(speed, size), from_deg)))), 1.0)) {
return `; for a wind of ${format(speed, `.4g`)} ${str(unit)} from ${format(from_deg, `g`)} degrees the speed comes first (weather reports have the direction first, and knots)`;
}
}
return "";
}

function _not_held(orbit, aircraft, air, tightest) {
let V, bank, limit, need, r, rate;
[r, V] = iter([aircraft.turn_radius_m, aircraft.airspeed_m_s]);
bank = `${format(aircraft.bank_deg(div(orbit.radius_m, tightest)), `.4g`)} deg`;
if ((aircraft.max_bank_deg != null)) {
[limit, need] = iter([`${format(aircraft.max_bank_deg, `.4g`)} deg of bank`, bank]);
} else {
if ((aircraft.max_turn_rate_deg_s != null)) {
rate = div(mul(mul(aircraft.max_turn_rate_deg_s, r), tightest), orbit.radius_m);
[limit, need] = iter([`${format(aircraft.max_turn_rate_deg_s, `.4g`)} deg/s`, `${format(rate, `.4g`)} deg/s (${str(bank)} of bank)`]);
} else {
[limit, need] = iter([`a turn radius of ${format(r, `.4g`)} m`, `a turn radius of ${format(div(orbit.radius_m, tightest), `.4g`)} m`]);
}
}
return `orbit radius ${format(orbit.radius_m, `g`)} m cannot be held in ${str(_air(orbit, mul(math.hypot(...iter(air)), V)))} at ${format(V, `.4g`)} m/s and ${str(limit)}: it needs ${format(mul(tightest, r), `.4g`)} m, or ${str(need)}`;
}

const _View = struct(class extends Tuple {
constructor(east, north, scale, height) {
super();
this.east = east;
this.north = north;
this.scale = scale;
this.height = height;

}
pixels(east_m, north_m) {
let x, y;
const self = this;
x = add(mul(0.5, WIDTH), mul(self.scale, sub(east_m, self.east)));
y = sub(mul(0.5, self.height), mul(self.scale, sub(north_m, self.north)));
return `${format(x, `.1f`)},${format(y, `.1f`)}`;
}
}, ["east", "north", "scale", "height"], '_View');

const Solved = struct(class extends Tuple {
constructor(maneuver, time) {
super();
this.maneuver = maneuver;
this.time = time;

}
}, ["maneuver", "time"], 'Solved');

function maneuver(problem, entry, miss) {
let aircraft, here, letter, miss_m, now, r, segments, t, wind;
[aircraft, wind] = iter([problem.aircraft, problem.wind]);
segments = [];
[here, now] = iter([problem.pose, 0.0]);
for ([letter, t] of rows(zip(letters(entry.word), sliced(entry, 2, null, null)))) {
r = aircraft.turn_radius_m;
append_(segments, segment(here, now, letter, mul(t, r), aircraft, wind, r));
[here, now] = iter([item(segments, -1).end, add(now, item(segments, -1).duration_s)]);
}
miss_m = mul(miss, aircraft.turn_radius_m);
return Maneuver(problem.pose, problem.orbit, aircraft, item(TURNS, entry.side), tuple(segments), miss_m, wind);
}

function _not_converged(problem) {
let pose, wind;
[pose, wind] = iter([problem.pose, problem.wind]);
return errors.NotConverged(`${str(item(_MESSAGES, kernel.Status.NOT_CONVERGED))}: pose ${format(pose.east_m, `g`)} ${format(pose.north_m, `g`)} ${format(pose.heading_deg, `g`)}, wind ${format(wind.speed_m_s, `.4g`)} m/s from ${format(wind.from_deg, `g`)}; try a pose moved by a millimetre`);
}

function _orbit(orbit) {
let text;
text = `east_m=${repr(orbit.east_m)}, north_m=${repr(orbit.north_m)}, radius_m=${repr(orbit.radius_m)}, turn="${str(orbit.turn)}"`;
if (truth(orbit.moves)) {
text = add(text, `, velocity_east_m_s=${repr(orbit.velocity_east_m_s)}, velocity_north_m_s=${repr(orbit.velocity_north_m_s)}`);
}
return `Orbit(${str(text)})`;
}

function extremals(problem) {
return maneuvers(solve_problem(problem, kernel.synthesis_ranked, kernel.wind_search_ranked));
}

const Candidate = struct(class extends Values {
constructor(word, turn, duration_s, later_s) {
super();
this.word = word;
this.turn = turn;
this.duration_s = duration_s;
this.later_s = later_s;

}
}, ["word", "turn", "duration_s", "later_s"], 'Candidate');

function _start(problem, side) {
let R, _, x, y;
if (truth(problem.has_closed_form)) {
[x, y, R, _, _] = iter(problem.reduced());
return RelativeStart(complex(x, y), add(1.0, new Complex(0.0, 0.0)), new Complex(0.0, 0.0), R, side);
}
return start_in_wind(problem, side);
}

function sign_of(turn) {
return int(item(SIDES, turn));
}

function held_turn(maneuver) {
if (!has(maneuver.turn, [Turn.CW, Turn.CCW])) {
throw errors.InvalidArgument("maneuver", `holds the circle ${repr(str(maneuver.turn))}: it must be cw or ccw`);
}
return maneuver.turn;
}

function durations_of(maneuver) {
let durations, seconds;
seconds = list(iter(maneuver.segments)).map((segment) => segment.duration_s);
durations = list(iter(seconds)).map((t) => div(mul(float(t), maneuver.aircraft.airspeed_m_s), maneuver.aircraft.turn_radius_m));
if (!truth(all(list(iter(durations)).map((t) => (le(0.0, t) && le(t, mul(8.0, REACH))))))) {
throw errors.InvalidArgument("maneuver", `has durations ${str(seconds)}: they must be zero or positive, finite seconds`);
}
return durations;
}

const Trajectory = struct(class extends Values {
constructor(maneuver, problem, start, lam, pieces) {
super();
this.maneuver = maneuver;
this.problem = problem;
this.start = start;
this.lam = lam;
this.pieces = pieces;

}
get first() {
const self = this;
return item(self.pieces, 0);
}
get last() {
const self = this;
return item(self.pieces, -1);
}
get end() {
let end;
const self = this;
if (!truth(self.pieces)) {
return [self.start.q, self.start.e];
}
end = self.last.end;
return [end.q, end.e];
}
get miss() {
let e, q;
const self = this;
[q, e] = iter(self.end);
return abs(sub(mul(q, conjugate_(e)), mul(mul(new Complex(0.0, 1.0), self.start.side), self.start.R)));
}
get beside() {
let e, q;
const self = this;
[q, e] = iter(self.end);
return max(abs(sub(abs(q), self.start.R)), div(abs(inner(q, add(e, self.start.w))), or(abs(q), () => 1.0)));
}
get opposed() {
const self = this;
return list(iter(pairwise(self.pieces))).map((one) => iter(one)).filter(([before, after]) => lt(mul(before.u, after.u), 0)).map(([before, after]) => after);
}
get duration() {
const self = this;
return sum(list(iter(self.pieces)).map((piece) => piece.t));
}
get violations() { return cached(this, "violations", () => {
let e, hamiltonian, lam, last, norm, now, off, piece, psi1, q, sign;
const self = this;
[lam, norm, sign, hamiltonian, psi1] = iter([self.lam, 0.0, 0.0, 0.0, 0.0]);
for (piece of iter(self.pieces)) {
for (now of iter(map((...given) => piece.at(...given), piece.instants))) {
norm = max(norm, abs(sub(abs(now.psi), 1.0)));
sign = max(sign, (truth(piece.u) ? mul(neg(piece.u), now.phi) : abs(now.phi)));
hamiltonian = max(hamiltonian, abs(sub(add(abs(now.phi), now.psi1), lam)));
psi1 = max(psi1, sub(now.psi1, lam));
}
}
[last, [q, e]] = iter([self.last, self.end]);
off = add(inner(last.p, add(e, last.w)), mul(end_rate(self.start, q, e, last.u), sub(lam, inner(last.p, e))));
off = mul(off, (truth(self.problem.still) ? self.start.R : 1.0));
return MaximumPrinciple(norm, max(0.0, sub(neg(lam), inner(last.p, last.w))), sign, hamiltonian, psi1, abs(off));
}); }
get worst_violation() {
let off;
const self = this;
off = self.violations;
return max(off.multiplier, off.sign, off.hamiltonian, off.transversality);
}
}, ["maneuver", "problem", "start", "lam", "pieces"], 'Trajectory');

function _in_still_air(start, controls, durations) {
let plan;
plan = _with_closed_form(start, controls, durations);
if ((ne(len(controls), 2) || has(0, controls))) {
return [plan];
}
return [or(_one_arc(plan), () => plan), ...iter(_switch_at_centre(plan))];
}

function _in_wind(start, controls, durations) {
let adjoints;
adjoints = _adjoints_in_wind(start, controls, durations);
return list(iter(adjoints)).map((adjoint) => FlightPlan(start, controls, durations, adjoint));
}

function* flown_pieces(start, controls, durations, adjoint) {
let _, e, phi, piece, q, t, u;
[q, e, phi] = iter([start.q, start.e, adjoint.phi]);
for ([u, t] of rows(zip(controls, durations))) {
piece = FlownPiece(u, t, q, e, phi, adjoint.p, start.w);
yield piece;
[q, e, _, phi] = iter(piece.end);
}
}

function accuracy__in_still_air(trajectory, others) {
let angle, central, choice, end, far, length, maneuver, pieces, problem, reduced, tie, tied;
[pieces, problem, reduced] = iter([trajectory.pieces, trajectory.problem, trajectory.problem.reduced()]);
length = kernel.rounding(reduced.x, reduced.y, reduced.R);
end = add(max(reduced.tolerance, length), length);
central = _of_switch_at_centre(trajectory, length);
angle = add(_angle_of_psi(trajectory, end, length), central);
tie = mul(2.0, length);
tied = any(list(iter(others)).map((other) => le(abs(other.later_s), mul(tie, problem.time_unit_s))));
choice = ((eq(len(pieces), 1) || truth(tied)) ? math.sqrt(length) : pow(length, div(2.0, 3.0)));
maneuver = trajectory.maneuver;
far = add(div(maneuver.length_m, maneuver.aircraft.turn_radius_m), reduced.R);
return Accuracy(end, length, angle, (lt(mul(2.0, length), trajectory.miss) && le(trajectory.miss, end)), add(add(add(end, length), mul(_heading_rounding(maneuver), far)), _ground_rounding(maneuver)), [_of_difference(max(list(iter(pieces)).map((piece) => piece.radius), { default: 0.0 }), length), _of_difference(1.0, ROUNDING), _of_difference(1.0, length)], MaximumPrinciple(ROUNDING, angle, add(angle, choice), add(angle, mul(2.0, choice)), add(angle, choice), (eq(len(pieces), 1) ? angle : add(length, central))), add(angle, _turned_by_last_switch(trajectory, end, length)), tie);
}

function accuracy_in_wind(trajectory) {
let T, angle, beside, choice, end, join, length, maneuver, start, tolerance, turning;
[start, maneuver, T] = iter([trajectory.start, trajectory.maneuver, trajectory.duration]);
length = kernel.rounding(start.q.real, start.q.imag, start.R);
end = add(mul(3.0, length), mul(mul(2.0, ROUNDING), T));
tolerance = trajectory.problem.in_wind().tolerance;
beside = (lt(end, trajectory.beside) && le(trajectory.beside, add(end, tolerance)));
end = add(end, (truth(beside) ? tolerance : 0.0));
turning = add(1.0, div(1.0, max(_length_of_direction(trajectory), end)));
angle = mul(end, turning);
choice = add(angle, math.sqrt(mul(mul(4.0, end), turning)));
join = add(add(end, mul(_heading_rounding(maneuver), add(1.0, T))), _ground_rounding(maneuver));
return Accuracy(end, length, angle, beside, join, mul([_of_difference(1.0, length)], 3), MaximumPrinciple(ROUNDING, choice, choice, mul(2.0, choice), choice, choice), choice, add(mul(WIND_TIE_TOLERANCE, add(add(1.0, start.R), T)), mul(2.0, _time_of_rounding(trajectory, length))));
}

function rounding_bound(maneuver, problem, proved_optimal) {
let R, _, converted, delta_m, found, planned, unit, x, y;
if (!truth(proved_optimal)) {
return RoundingBound(null, null, NOT_CLAIMED);
}
planned = fastest(problem);
if ((ne(planned.turn, maneuver.turn) || ne(planned.segments, maneuver.segments))) {
return RoundingBound(null, null, NOT_PLANNED);
}
[x, y, R, _, _] = iter(problem.reduced());
found = units_at(x, mul(item(SIDES, maneuver.turn), y), R);
unit = mul(UNIT, scale_of(x, y, R));
converted = mul(OF_SECONDS, maneuver.duration_s);
delta_m = add(mul(mul(found.delta, unit), problem.aircraft.turn_radius_m), mul(converted, problem.aircraft.airspeed_m_s));
return RoundingBound(delta_m, add(mul(mul(found.epsilon, unit), problem.time_unit_s), converted), BY_THEOREMS);
}

function _instant(piece, began, s, unit_s) {
let now;
now = piece.at(s);
return Instant(mul(add(began, s), unit_s), piece.u, now.phi, now.psi1, now.psi2);
}

function certificate_values(certificate) {
let maneuver, rounding, runner_up;
[maneuver, runner_up, rounding] = iter([certificate.maneuver, certificate.runner_up, certificate.rounding]);
return new Map([["valid", certificate.valid], ["proved_optimal", certificate.proved_optimal], ["basis", certificate.basis], ["delta_m", rounding.delta_m], ["epsilon_s", rounding.epsilon_s], ["rounding", rounding.basis], ["word", maneuver.word], ["turn", maneuver.turn], ["duration_s", maneuver.duration_s], ["lambda", certificate.lam], ["psi", certificate.psi], ["choice", certificate.choice], ["switches", list(iter(certificate.switches)).map((switch_) => asdict(switch_))], ["residuals", list(iter(certificate.residuals)).map((residual) => _plain(residual))], ["candidates", list(iter(certificate.others)).map((other) => bit_or(asdict(other), new Map([["turn", other.turn]])))], ["runner_up", ((runner_up == null) ? null : runner_up.word)], ["margin_s", certificate.margin_s]]);
}

const Switch = struct(class extends Values {
constructor(time_s, letters, x, y, psi1, psi2) {
super();
this.time_s = time_s;
this.letters = letters;
this.x = x;
this.y = y;
this.psi1 = psi1;
this.psi2 = psi2;

}
}, ["time_s", "letters", "x", "y", "psi1", "psi2"], 'Switch');

function* _check(conditions, trajectory, accuracy) {
let condition, violation;
for (condition of iter(conditions)) {
violation = condition.violation(trajectory, accuracy);
if ((violation != null)) {
yield Residual(condition.name, condition.equation, ...iter(violation));
}
}
}

function* motion_residuals(motions, trajectory, accuracy) {
let bound, motion, off, piece, rise, s;
for ([motion, bound] of rows(zip(motions, accuracy.motion))) {
off = 0.0;
for (piece of iter(trajectory.pieces)) {
for (s of iter(piece.instants)) {
rise = sub(motion.quantity(piece.at(add(s, STEP))), motion.quantity(piece.at(sub(s, STEP))));
off = max(off, abs(sub(div(rise, mul(2.0, STEP)), motion.rate(piece, piece.at(s)))));
}
}
yield Residual(motion.name, motion.equation, off, bound);
}
}

const Residual = struct(class extends Values {
constructor(name, equation, value, bound, note = "") {
super();
this.name = name;
this.equation = equation;
this.value = value;
this.bound = bound;
this.note = note;

}
get skipped() {
const self = this;
return (self.value == null);
}
get failed() {
const self = this;
return and(and((self.value != null), () => (self.bound != null)), () => !le(self.value, self.bound));
}
get verdict() {
const self = this;
return (truth(self.skipped) ? "skipped" : (truth(self.failed) ? "FAILED" : "holds"));
}
}, ["name", "equation", "value", "bound", "note"], 'Residual');

function* gradient_residuals(equations, trajectory, accuracy) {
let _, adjoint, by_east, by_motion, by_north, c, corner, gradient, note, off, skipped, slopes, start, times;
times = least_times(trajectory);
gradient = (truth(accuracy.beside) ? null : gradient_of(times));
if ((gradient == null)) {
corner = (truth(accuracy.beside) ? [] : tuple(corner_residuals(equations, trajectory, accuracy, times)));
note = (truth(accuracy.beside) ? BESIDE_LAST_ARC : times.not_smooth());
skipped = list(iter(items_(equations._asdict()))).map((one) => iter(one)).map(([name, equation]) => Residual(name, equation, null, null, note));
yield* iter(or(corner, () => skipped));
return;
}
[start, slopes] = iter([trajectory.first, gradient.slopes]);
c = add(trajectory.lam, inner(start.p, start.w));
adjoint = [start.p.real, start.p.imag, start.phi];
off = math.hypot(...iter(list(iter(zip(slopes, adjoint))).map((one) => iter(one)).map(([slope, along]) => add(mul(c, slope), along))));
yield Residual("gradient", equations.gradient, off, add(mul(abs(c), gradient.bound), accuracy.gradient));
[by_east, by_north, ..._] = iter(slopes);
by_motion = inner(complex(by_east, by_north), add(start.e, start.w));
off = abs(sub(add(1.0, by_motion), abs(times.by_heading(slopes))));
yield Residual("bellman", equations.bellman, off, mul(times.motion_size, gradient.bound));
}

function _comparison(trajectory, accuracy, others) {
let note, other, sooner;
[sooner, note] = iter([0.0, ""]);
for (other of iter(others)) {
if (gt(div(neg(other.later_s), trajectory.problem.time_unit_s), sooner)) {
sooner = div(neg(other.later_s), trajectory.problem.time_unit_s);
note = (gt(sooner, accuracy.tie) ? `${str(other.word)} ${str(other.turn)} is faster` : "");
}
}
return Residual("fastest", "T is the least of all candidates", sooner, accuracy.tie, note);
}

function start_in_wind(problem, side) {
let R, _, c, s, wx, wy, x, y;
[x, y, c, s, R, _, wx, wy, _] = iter(problem.in_wind());
return RelativeStart(complex(x, y), complex(c, s), complex(wx, wy), R, side);
}

function* _adjoints(start, controls, durations) {
let pieces;
pieces = list(flown_pieces(start, controls, durations, InitialAdjoint(add(1.0, new Complex(0.0, 0.0)), 1.0, 0.0)));
yield* iter(switch_adjoints(start, pieces));
if (lt(sum(list(iter(pieces)).map((piece) => gt(piece.t, SHORT))), 3)) {
yield vanishing_at(start, pieces, item(pieces, -1), item(pieces, -1).e, 1.0);
}
}

function _held_circle(trajectory, problem, slot) {
let at, start, way;
start = trajectory.start;
way = neg(float(sign_of(problem.orbit.turn)));
at = HeldCircle(math.radians(sub(90.0, slot.phase_deg)), way, start.R, start.w);
return at.after(div(neg(slot.at_s), problem.time_unit_s));
}

function no_arrival_before(start, heading, circle, until) {
let begin, end, ends, gap, last, later, limit, passed, reached, stopped;
[reached, later] = iter([mul(REACHED, add(1.0, until)), resolution(until)]);
[begin, last] = iter([0.0, circle.width(until)]);
passed = [];
limit = circle.width(max(sub(until, mul(0.9, later)), 0.0));
while (truth(true)) {
stopped = _first_unclear(start, heading, circle, np.linspace(begin, last, BEGIN), mul(FINEST, add(1.0, until)));
if (((stopped == null) || le(sub(until, stopped.time), later))) {
return LowerBound(((stopped == null) ? until : stopped.time), tuple(passed));
}
[begin, end] = iter([stopped.width, _end_of_pass(start, heading, circle, stopped.width, limit)]);
gap = _least_gap(start, heading, circle, begin, end);
if (le(gap, reached)) {
return LowerBound(stopped.time, tuple(passed));
}
ends = float(item(circle.time(np.array([end])), 0));
append_(passed, NearPass(stopped.time, ends, gap));
if (ge(end, limit)) {
return LowerBound(ends, tuple(passed));
}
begin = end;
}
}

function _slot_at_end(trajectory, slot) {
let held;
held = trajectory.problem.with_turn(held_turn(trajectory.maneuver));
return _held_circle(trajectory, held, slot).after(trajectory.duration).state();
}

function _passes(problem, first) {
let r, unit_s;
[unit_s, r] = iter([problem.time_unit_s, problem.aircraft.turn_radius_m]);
return join_("; ", list(iter(first.passed)).map((one) => `by samples from ${format(mul(one.begin, unit_s), `.6g`)} to ${format(mul(one.end, unit_s), `.6g`)} s, ${format(mul(one.gap, r), `.2g`)} m from reach`));
}

function _outside(exit_to, orbit) {
let distance, east, north;
if (truth(orbit.moves)) {
throw errors.InvalidArgument("orbit", "moves: the way out is planned for a circle that is fixed to the ground");
}
[east, north] = iter(exit_to);
[east, north] = iter([number("exit_to east_m", east, "metres"), number("exit_to north_m", north, "metres")]);
distance = math.hypot(sub(east, orbit.east_m), sub(north, orbit.north_m));
if (lt(distance, mul(orbit.radius_m, sub(1.0, ROUNDING)))) {
throw errors.InvalidArgument("exit_to", `is ${format(distance, `.4g`)} m from the centre: it must be outside the circle of ${format(orbit.radius_m, `g`)} m`);
}
return [east, north];
}

function leg__planned(leg, problem, climb_s) {
let _, east, entry, exit_, found, hold, miss, north, orbit, out, point, r, scene, side, speed_m_s, straight_m, unit_s;
[orbit, r, unit_s] = iter([problem.orbit, problem.aircraft.turn_radius_m, problem.time_unit_s]);
scene = kernel.scene_of(problem.in_wind());
[east, north] = iter([div(sub(item(leg.exit_to, 0), orbit.east_m), r), div(sub(item(leg.exit_to, 1), orbit.north_m), r)]);
side = sign_of(orbit.turn);
point = kernel.exit_point(east, north, side, scene.R);
out = WayOut(side, kernel.phase_of(...iter(point), side, scene.wx, scene.wy), div(leg.hold_s, unit_s), mul(math.tau, leg.turns), div(climb_s, unit_s));
_check_length(out, scene);
found = kernel.soonest_exit(out, scene);
hold = _hold_after_longer_path(found, out, scene, problem);
if ((hold == null)) {
[entry, miss] = iter(kernel.entry_before(found, out, scene));
hold = leg_Hold(maneuver(problem, entry, miss), found.width, sub(found.time, found.path.time));
}
exit_ = _exit_pose(orbit, out, scene, r);
straight_m = math.hypot(sub(item(leg.exit_to, 0), exit_.east_m), sub(item(leg.exit_to, 1), exit_.north_m));
[_, speed_m_s] = iter(hold.entry.over_ground(exit_));
return LegPlan(leg, hold.entry, mul(hold.time, unit_s), math.degrees(hold.width), exit_, div(straight_m, speed_m_s));
}

const HoldState = struct(class extends Tuple {
constructor(time_s, east_m, north_m, heading_deg) {
super();
this.time_s = time_s;
this.east_m = east_m;
this.north_m = north_m;
this.heading_deg = heading_deg;

}
}, ["time_s", "east_m", "north_m", "heading_deg"], 'HoldState');

function _shares(held_deg) {
let first, shares, steps, turns;
turns = div(held_deg, 360.0);
if (eq(turns, 0.0)) {
return [];
}
first = min(turns, 1.0);
steps = [max(round(mul(LAP_STEPS, first)), 1), min(round(mul(LAP_STEPS, sub(turns, first))), MOST_STATES)];
shares = list(iter(range(item(steps, 0)))).map((i) => div(mul(div(first, turns), add(i, 1)), item(steps, 0)));
return add(shares, list(iter(range(item(steps, 1)))).map((i) => div(add(first, div(mul(sub(turns, first), add(i, 1)), item(steps, 1))), turns)));
}

function exit_altitude_m(plan) {
let altitude_m, leg;
leg = plan.leg;
altitude_m = ((leg.altitude_m == null) ? leg.pose.altitude_m : leg.altitude_m);
if ((altitude_m == null)) {
throw errors.InvalidArgument("altitude_m", "is missing: a mission needs the altitude of the pose or of the leg");
}
return MEAN_SEA_LEVEL.checked(altitude_m);
}

function _loiter(plan, autopilot) {
let given, leg, needs, radius_m, turns;
[leg, radius_m] = iter([plan.leg, plan.leg.orbit.radius_m]);
given = new Map([["altitude_m", ne(leg.climb_m, 0.0)], ["turns", gt(leg.turns, 0.0)], ["hold_s", gt(leg.hold_s, 0.0)]]);
needs = list(iter(items_(given))).map((one) => iter(one)).filter(([name, is_given]) => truth(is_given)).map(([name, is_given]) => name);
if (gt(len(needs), 1)) {
throw errors.InvalidArgument(item(needs, 1), `goes with ${str(item(needs, 0))} in no mission: a loiter ends for one reason`);
}
if (gt(leg.turns, 0.0)) {
if (eq(autopilot, Autopilot.PX4)) {
throw errors.InvalidArgument("turns", "are in no mission of PX4: give a time or an altitude");
}
turns = math.ceil(leg.turns);
if ((gt(turns, legs_MOST_TURNS) || gt(radius_m, LARGEST_TURNS_RADIUS_M))) {
throw errors.InvalidArgument("turns", `are stored by ArduPlane up to ${format(legs_MOST_TURNS, `g`)}, with a radius of up to ${format(LARGEST_TURNS_RADIUS_M, `g`)} m: ${format(turns, `g`)} with ${format(radius_m, `g`)} m are not`);
}
return [MavCommand.NAV_LOITER_TURNS, [float(turns), 0.0, 0.0, FROM_EXIT]];
}
if (gt(leg.hold_s, 0.0)) {
if (eq(autopilot, Autopilot.ARDUPILOT)) {
throw errors.InvalidArgument("hold_s", "has no radius in a mission of ArduPlane, which flies NAV_LOITER_TIME with WP_LOITER_RAD: give turns or an altitude");
}
return [MavCommand.NAV_LOITER_TIME, [leg.hold_s, HEADING_REQUIRED, 0.0, FROM_EXIT]];
}
return [MavCommand.NAV_LOITER_TO_ALT, [HEADING_REQUIRED, 0.0, 0.0, FROM_EXIT]];
}

function _item(command, params, place, altitude_m) {
return MissionItem(command, Frame.ABOVE_SEA, params, ...iter(place), altitude_m);
}

function _fastest_clear(fence, problem, margin_m) {
let aircraft, best, blocking, fastest_m_s, found, known, later_s, least_s, orbit;
[aircraft, orbit] = iter([problem.aircraft, problem.orbit]);
known = extremals(problem);
found = first_clear(fence, known, margin_m);
if ((truth(found.is_fastest) || truth(orbit.moves))) {
return found;
}
if (truth((blocking = zones_on_circle(fence, item(known, 0), margin_m)))) {
return replace(found, { blocking: blocking, least_s: math.inf });
}
fastest_m_s = add(aircraft.airspeed_m_s, problem.wind.speed_m_s);
least_s = max(item(known, 0).duration_s, div(arrays.no_length(fence, problem, margin_m), fastest_m_s));
best = (lt(least_s, math.inf) ? _Search(fence, problem, margin_m).fastest(found.maneuver, item(known, 0).length_m) : null);
if ((best == null)) {
return replace(found, { searched: true, least_s: least_s });
}
later_s = sub(best.duration_s, item(known, 0).duration_s);
return replace(found, { maneuver: best, check: fence.check(best, margin_m), later_s: later_s, searched: true, least_s: least_s });
}

function checked_margin_m(orbit, margin_m) {
return ((margin_m == null) ? default_margin_m(orbit) : not_negative("margin_m", margin_m, "metres"));
}

function _join_over_ground(maneuver) {
let centre, speed, track_deg;
[track_deg, speed] = iter(maneuver.over_ground(maneuver.join));
centre = maneuver.orbit_at_join;
return new Map([["track_deg", track_deg], ["ground_speed_m_s", speed], ["centre_east_m", centre.east_m], ["centre_north_m", centre.north_m]]);
}

function maneuver__segment(segment, pose) {
return new Map([["letter", segment.letter], ["start_s", segment.start_s], ["duration_s", segment.duration_s], ["length_m", segment.length_m], ["curvature_per_m", segment.curvature_per_m], ["start", pose(segment.start)], ["end", pose(segment.end)]]);
}

function arc_to_edge(arcs, edges) {
return _least(...iter(arc_edge_points(arcs, edges)));
}

function arcs_of(pieces) {
let angle, nx, ny, p;
p = pieces.take([slice(null), null]);
[nx, ny] = iter([mul(p.u, p.s), mul(neg(p.u), p.c)]);
angle = div(mul(p.duration_s, p.speed), p.radius);
return Arcs(sub(p.x, mul(p.radius, nx)), sub(p.y, mul(p.radius, ny)), p.radius, nx, ny, p.u, angle);
}

function _note(closest, distance, share, pieces, bent, zone) {
let own, piece;
piece = np.broadcast_to(item(bent, [slice(null, null), null]), distance.shape);
own = np.broadcast_to(zone, distance.shape);
closest.note(own.ravel(), distance.ravel(), piece.ravel(), mul(share, item(pieces.duration_s, piece)).ravel());
}

const Chords = struct(class extends Tuple {
constructor(ax, ay, bx, by, off, widen) {
super();
this.ax = ax;
this.ay = ay;
this.bx = bx;
this.by = by;
this.off = off;
this.widen = widen;

}
static of(cls, pieces, parts) {
let off, own;
own = pieces.take(parts.piece);
off = div(mul(own.acceleration, pow(sub(parts.b, parts.a), 2)), 8.0);
return cls(...iter(own.position(parts.a)), ...iter(own.position(parts.b)), off, own.widen);
}
columns() {
const self = this;
return Chords(...iter(list(iter(self)).map((column) => item(column, [slice(null, null), null]))));
}
}, ["ax", "ay", "bx", "by", "off", "widen"], 'Chords');

function _undecided(closest, lower, zone, margin_m, unsigned) {
let known, matters, touches;
known = item(closest.distance, zone);
touches = (truth(unsigned) ? le(known, TOUCH_M) : np.zeros(known.shape, bool));
matters = bit_or(le(lower, add(margin_m, TOUCH_M)), lt(lower, sub(closest.distance.min(), RESOLUTION_M)));
return item(bit_and(bit_and(lt(lower, sub(known, RESOLUTION_M)), invert(touches)), matters).nonzero(), 0);
}

function chord_to_edge(ax, ay, bx, by, edges) {
let distances, shares;
[distances, shares] = iter(chord_edge_points(ax, ay, bx, by, edges));
return ChordToEdge(item(distances, 0), item(distances, 1), _least(distances, shares));
}

function _around(found, chords, parts) {
let at, distance;
at = add(parts.a, mul(found.share, sub(parts.b, parts.a)));
distance = sub(found.distance, chords.widen);
return Bounds(sub(distance, chords.off), add(distance, chords.off), at);
}

function arc_to_point(arcs, x, y) {
let at_ends, away, ends, far, largest, least, near, qx, qy, r, safe, towards, vx, vy, zero;
[vx, vy] = iter([sub(x, arcs.x), sub(y, arcs.y)]);
r = np.hypot(vx, vy);
safe = np.maximum(r, np.finfo(float).tiny);
[qx, qy] = iter([div(vx, safe), div(vy, safe)]);
at_ends = list(iter([0.0, 1.0])).map((share) => arcs.direction(share));
ends = list(iter(at_ends)).map((one) => iter(one)).map(([ox, oy]) => np.hypot(sub(mul(arcs.radius, ox), vx), sub(mul(arcs.radius, oy), vy)));
[towards, away] = iter([arcs.share(qx, qy), arcs.share(neg(qx), neg(qy))]);
[near, far] = iter([np.where(le(towards, 1.0), abs(sub(r, arcs.radius)), np.inf), np.where(le(away, 1.0), add(r, arcs.radius), neg(np.inf))]);
zero = np.zeros_like(r);
least = _least([...iter(ends), near], [zero, add(zero, 1.0), towards]);
largest = _least([...iter(list(iter(ends)).map((end) => neg(end))), neg(far)], [zero, add(zero, 1.0), away]);
return Extremes(least, Nearest(neg(largest.distance), largest.share));
}

const Parts = struct(class extends Tuple {
constructor(piece, a, b) {
super();
this.piece = piece;
this.a = a;
this.b = b;

}
split() {
let shares, times;
const self = this;
shares = div(np.arange(add(SPLIT, 1)), SPLIT);
times = add(item(self.a, [slice(null, null), null]), mul(shares, item(sub(self.b, self.a), [slice(null, null), null])));
return Parts(np.repeat(self.piece, SPLIT), item(times, [slice(null, null), slice(null, -1)]).ravel(), item(times, [slice(null, null), slice(1, null)]).ravel());
}
take(i) {
const self = this;
return Parts(item(self.piece, i), item(self.a, i), item(self.b, i));
}
}, ["piece", "a", "b"], 'Parts');

function chord_to_point(ax, ay, bx, by, x, y) {
let share;
share = foot_share(x, y, ax, ay, bx, by);
return Nearest(np.hypot(sub(add(ax, mul(share, sub(bx, ax))), x), sub(add(ay, mul(share, sub(by, ay))), y)), share);
}

const Nearest = struct(class extends Tuple {
constructor(distance, share) {
super();
this.distance = distance;
this.share = share;

}
}, ["distance", "share"], 'Nearest');

const Bounds = struct(class extends Tuple {
constructor(lower, upper, at) {
super();
this.lower = lower;
this.upper = upper;
this.at = at;

}
}, ["lower", "upper", "at"], 'Bounds');

function _first_touch(pieces, simple, zone) {
let arcs, ax, ay, bent, bx, by, i, lines, share, straight, times, touched;
share = np.full(pieces.x.size, np.inf);
[bent, straight] = iter(list(iter([pieces.bent, eq(pieces.u, 0.0)])).map((kind) => item(bit_and(simple, kind).nonzero(), 0)));
if (truth(bent.size)) {
arcs = arcs_of(pieces.take(bent));
if (truth(isinstance(zone, PolygonZone))) {
set_item(share, bent, first_within(...iter(arc_edge_points(arcs, zone._edges)), TOUCH_M).min({ axis: -1 }));
} else {
set_item(share, bent, first_within(...iter(arc_circle_points(arcs, ...iter(_disc(zone)))), TOUCH_M).min({ axis: -1 }));
}
}
if (truth(straight.size)) {
lines = pieces.take(straight);
[[ax, ay], [bx, by]] = iter(list(iter([0.0, lines.duration_s])).map((t) => list(iter(lines.position(t))).map((v) => item(v, [slice(null, null), null]))));
if (truth(isinstance(zone, PolygonZone))) {
set_item(share, straight, first_within(...iter(chord_edge_points(ax, ay, bx, by, zone._edges)), TOUCH_M).min({ axis: -1 }));
} else {
set_item(share, straight, first_within(...iter(chord_circle_points(ax, ay, bx, by, ...iter(_disc(zone)))), TOUCH_M).min({ axis: -1 }));
}
}
touched = item(lt(share, np.inf).nonzero(), 0);
if (!truth(touched.size)) {
return PlaceInPath(np.inf, 0, 0.0);
}
times = mul(item(share, touched), item(pieces.duration_s, touched));
i = int(add(item(pieces.start_s, touched), times).argmin());
return PlaceInPath(0.0, int(item(touched, i)), float(item(times, i)));
}

function _searched_entry(pieces, searched, zone, known, known_s) {
let _, before, entry, entry_s, found, i, keep, parts, step_s, times;
parts = first_parts(pieces, searched);
step_s = div(TOUCH_M, float(add(pieces.speed, np.hypot(pieces.wx, pieces.wy)).max()));
[entry, entry_s] = iter([known, known_s]);
for (_ of iter(range(MOST_LEVELS))) {
found = signed_bounds(zone, Chords.of(pieces, parts), parts);
times = np.where(le(found.upper, TOUCH_M), add(item(pieces.start_s, parts.piece), found.at), np.inf);
i = int(times.argmin());
if (lt(item(times, i), entry_s)) {
[entry, entry_s] = iter([PlaceInPath(float(item(found.upper, i)), int(item(parts.piece, i)), float(item(found.at, i))), float(item(times, i))]);
}
before = lt(add(item(pieces.start_s, parts.piece), parts.a), entry_s);
keep = bit_and(bit_and(before, le(found.lower, TOUCH_M)), gt(sub(parts.b, parts.a), step_s));
parts = parts.take(item(keep.nonzero(), 0));
if (!truth(parts.piece.size)) {
break;
}
parts = parts.split();
}
return entry;
}

function signed_bounds(zone, chords, parts) {
let at_a, at_b, bounds, lower, upper;
bounds = (truth(isinstance(zone, CircleZone)) ? _from_circle(zone, chords) : _from_polygon(zone, chords));
[lower, at_a, at_b] = iter(bounds);
upper = sub(np.minimum(at_a, at_b), chords.widen);
return Bounds(sub(sub(lower, chords.off), chords.widen), upper, np.where(lt(at_b, at_a), parts.b, parts.a));
}

function fence__place(breach, frame, decimals) {
let d, east, north, place;
if ((frame != null)) {
place = frame.place(Pose(breach.east_m, breach.north_m, 0.0));
return degrees_of(place.latitude_deg, place.longitude_deg);
}
d = sub(decimals, 1);
[east, north] = iter([(ge(breach.east_m, 0.0) ? "east" : "west"), (ge(breach.north_m, 0.0) ? "north" : "south")]);
return `${format(abs(breach.east_m), `.${String(d)}f`)} m ${str(east)}, ${format(abs(breach.north_m), `.${String(d)}f`)} m ${str(north)}`;
}

function _named(zone) {
return `the ${str((truth(zone.inclusion) ? "inclusion zone" : "zone"))} ${repr(zone.name)}`;
}

function _and_others(others) {
let names;
names = join_(" and ", list(iter(others)).map((breach) => repr(breach.zone.name)));
return `later also ${str(names)}`;
}

function segment(start, start_s, letter, length_m, aircraft, wind, radius_m) {
let end, u;
u = item(CONTROLS, letter);
end = flown_from(start, u, length_m, aircraft, wind, radius_m);
return Segment(letter, start_s, div(length_m, aircraft.airspeed_m_s), length_m, div(u, radius_m), start, end);
}

const RelativeStart = struct(class extends Tuple {
constructor(q, e, w, R, side) {
super();
this.q = q;
this.e = e;
this.w = w;
this.R = R;
this.side = side;

}
}, ["q", "e", "w", "R", "side"], 'RelativeStart');

function end_rate(start, q, e, u) {
let g, over_ground, radius;
radius = (eq(start.w, 0.0) ? start.R : or(abs(q), () => start.R));
over_ground = add(e, start.w);
g = abs(over_ground);
return div(mul(mul(neg(start.side), u), pow(g, 3)), mul(radius, inner(e, over_ground)));
}

const MaximumPrinciple = struct(class extends Tuple {
constructor(norm, multiplier, sign, hamiltonian, psi1, transversality) {
super();
this.norm = norm;
this.multiplier = multiplier;
this.sign = sign;
this.hamiltonian = hamiltonian;
this.psi1 = psi1;
this.transversality = transversality;

}
}, ["norm", "multiplier", "sign", "hamiltonian", "psi1", "transversality"], 'MaximumPrinciple');

function _with_closed_form(start, controls, durations) {
let lam, psi1, psi2, t1, t2, t3, x, y;
[x, y] = iter([start.q.real, start.q.imag]);
[t1, t2, t3] = iter(sliced([...iter(durations), 0.0, 0.0], null, 3, null));
[lam, psi1, psi2] = iter(kernel.adjoint(x, y, start.R, Entry(start.side, arrays.encode(...iter(controls)), t1, t2, t3)));
return FlightPlan(start, controls, durations, InitialAdjoint(complex(psi1, psi2), lam, kernel.switching_function(x, y, psi1, psi2)));
}

function _one_arc(plan) {
let _, end_x, end_y, first, last, late, size, start, u, v, x, y;
[start, [u, v], [first, last], _] = iter(plan);
[x, y] = iter([start.q.real, start.q.imag]);
size = kernel.rounding(x, y, start.R);
late = _with_closed_form(replace(start, { q: complex(...iter(kernel.flow(x, y, u, first))) }), [v], [last]);
if (le(mul(add(abs(late.adjoint.phi), first), first), mul(late.adjoint.lam, size))) {
return late;
}
[end_x, end_y] = iter(kernel.flow(x, y, u, add(first, last)));
if (le(math.hypot(end_x, sub(end_y, mul(start.side, start.R))), size)) {
return _with_closed_form(start, [u], [add(first, last)]);
}
return null;
}

function* _switch_at_centre(plan) {
let _, first, psi1, psi2, start, u, x, y;
[start, [u, _], [first, _], _] = iter(plan);
[x, y] = iter([start.q.real, start.q.imag]);
if (le(math.hypot(...iter(kernel.flow(x, y, u, first))), math.sqrt(kernel.rounding(x, y, start.R)))) {
[psi1, psi2] = iter(kernel.turn_adjoint(1.0, 0.0, u, neg(first)));
yield replace(plan, { adjoint: InitialAdjoint(complex(psi1, psi2), 1.0, kernel.switching_function(x, y, psi1, psi2)) });
}
}

function* _adjoints_in_wind(start, controls, durations) {
let before, piece, pieces;
pieces = list(flown_pieces(start, controls, durations, InitialAdjoint(add(1.0, new Complex(0.0, 0.0)), 1.0, 0.0)));
yield* iter(switch_adjoints(start, pieces));
for ([before, piece] of rows(pairwise(pieces))) {
if ((truth(piece.u) && (truth(before.u) || le(before.t, SHORT)))) {
yield* iter(_transversal(start, pieces, piece));
}
}
if (le(sum(list(iter(pieces)).map((piece) => gt(piece.t, SHORT))), 1)) {
yield* iter(_of_single_arc(start, pieces));
}
}

const FlightPlan = struct(class extends Tuple {
constructor(start, controls, durations, adjoint) {
super();
this.start = start;
this.controls = controls;
this.durations = durations;
this.adjoint = adjoint;

}
}, ["start", "controls", "durations", "adjoint"], 'FlightPlan');

const FlownPiece = struct(class extends Tuple {
constructor(u, t, q, e, phi, p, w) {
super();
this.u = u;
this.t = t;
this.q = q;
this.e = e;
this.phi = phi;
this.p = p;
this.w = w;

}
at(s) {
let chord, e, half, phi, through_air;
const self = this;
half = cmath.exp(mul(mul(new Complex(0.0, 0.5), self.u), s));
chord = (truth(self.u) ? mul(2.0, math.sin(mul(0.5, s))) : s);
[through_air, e] = iter([mul(mul(chord, self.e), half), mul(mul(self.e, half), half)]);
phi = sub(self.phi, inner(self.p, mul(new Complex(0.0, 1.0), through_air)));
return PieceState(add(add(self.q, through_air), mul(self.w, s)), e, mul(self.p, conjugate_(e)), phi);
}
get start() {
const self = this;
return self.at(0.0);
}
get end() {
const self = this;
return self.at(self.t);
}
get instants() {
let even, extreme, psi;
const self = this;
even = list(iter(range(SAMPLES))).map((i) => div(mul(self.t, i), sub(SAMPLES, 1)));
psi = self.start.psi;
extreme = mod(mul(self.u, math.atan2(psi.imag, psi.real)), math.pi);
return add(even, list(iter([extreme, add(extreme, math.pi)])).filter((s) => (truth(self.u) && lt(s, self.t))).map((s) => s));
}
get radius() {
const self = this;
return abs(add(self.start.reduced, mul(new Complex(0.0, 1.0), self.u)));
}
}, ["u", "t", "q", "e", "phi", "p", "w"], 'FlownPiece');

function _of_switch_at_centre(trajectory, length) {
let distance;
if ((ne(len(trajectory.pieces), 2) || !truth(trajectory.opposed))) {
return 0.0;
}
distance = abs(trajectory.last.q);
return (le(distance, math.sqrt(length)) ? mul(4.0, distance) : 0.0);
}

function _angle_of_psi(trajectory, end, length) {
let _, middle, pieces, reduced, second;
[pieces, reduced] = iter([trajectory.pieces, trajectory.problem.reduced()]);
if (eq(len(pieces), 1)) {
return mul(end, add(1.0, div(add(1.0, reduced.R), max(math.hypot(reduced.x, reduced.y), length))));
}
middle = 1.0;
if (eq(len(pieces), 3)) {
[_, second, _] = iter(pieces);
middle = (truth(second.u) ? second.radius : 1.0);
}
return mul(end, add(1.0, div(1.0, max(middle, length))));
}

const Accuracy = struct(class extends Tuple {
constructor(end, length, angle, beside, join, motion, maximum_principle, gradient, tie) {
super();
this.end = end;
this.length = length;
this.angle = angle;
this.beside = beside;
this.join = join;
this.motion = motion;
this.maximum_principle = maximum_principle;
this.gradient = gradient;
this.tie = tie;

}
}, ["end", "length", "angle", "beside", "join", "motion", "maximum_principle", "gradient", "tie"], 'Accuracy');

function _heading_rounding(maneuver) {
return mul(mul(6.0, pow(2.0, -52)), math.radians(add(abs(maneuver.start.heading_deg), 720.0)));
}

function _ground_rounding(maneuver) {
let centre, coordinates, metres, speeds, start;
[start, centre] = iter([maneuver.start, maneuver.orbit]);
coordinates = sum(map(abs, [start.east_m, start.north_m, centre.east_m, centre.north_m]));
speeds = add(maneuver.wind.speed_m_s, math.hypot(centre.velocity_east_m_s, centre.velocity_north_m_s));
metres = add(add(coordinates, maneuver.length_m), mul(speeds, maneuver.duration_s));
return div(mul(ROUNDING, metres), maneuver.aircraft.turn_radius_m);
}

function _of_difference(third_derivative, rounding) {
return add(mul(div(mul(STEP, STEP), 6.0), third_derivative), div(rounding, STEP));
}

function _turned_by_last_switch(trajectory, end, length) {
let _, last, moved, radii, x, y;
if (!truth(trajectory.opposed)) {
return 0.0;
}
[_, last] = with_middle(trajectory.opposed, 0, 1);
[x, y] = iter([last.start.x, last.start.y]);
radii = mul(math.hypot(x, add(y, 1.0)), math.hypot(x, sub(y, 1.0)));
moved = min(div(mul(end, radii), max(mul(2.0, abs(x)), length)), math.sqrt(mul(end, radii)));
return div(moved, max(math.hypot(x, y), length));
}

function _length_of_direction(trajectory) {
let _, middle, pieces;
pieces = trajectory.pieces;
if (eq(trajectory.lam, 1.0)) {
return min(1.0, max(list(iter(pieces)).filter((piece) => eq(piece.u, 0)).map((piece) => piece.t), { default: 1.0 }));
}
if (lt(len(pieces), 3)) {
return 1.0;
}
[_, middle, _] = iter(pieces);
return min(1.0, mul(2.0, abs(math.sin(mul(0.5, middle.t)))));
}

function _time_of_rounding(trajectory, length) {
let first, steep;
if (!truth(trajectory.pieces)) {
return length;
}
first = trajectory.first;
steep = add(trajectory.lam, inner(first.p, first.w));
return max(length, min(div(length, max(steep, length)), math.sqrt(length)));
}

const RoundingBound = struct(class extends Tuple {
constructor(delta_m, epsilon_s, basis) {
super();
this.delta_m = delta_m;
this.epsilon_s = epsilon_s;
this.basis = basis;

}
}, ["delta_m", "epsilon_s", "basis"], 'RoundingBound');

function fastest(problem) {
let _, best;
[best, ..._] = iter(solve_problem(problem, _optimum_alone, _fastest_alone));
return best.maneuver;
}

function units_at(x, y, R) {
let gap, is_lrl, scale, start, v;
[start, scale] = iter([kernel.start_at(x, y, R, 0.0), scale_of(x, y, R)]);
if ((lt(add(1.0, math.sqrt(3.0)), R) || gt(start.fold, mul(mul(NO_FOLD, scale), scale)))) {
return Units(MISS, (le(R, WIDE) ? LATE : LATE_BEYOND));
}
[gap, v] = iter(kernel.lrl_quadratic(start));
is_lrl = ge(sub(mul(gap, gap), mul(3.0, v)), mul(mul(neg(OF_D), gap), gap));
return (truth(is_lrl) ? Units(MISS_OF_LRL, LATE_OF_LRL) : Units(MISS, LATE));
}

function scale_of(x, y, R) {
return div(kernel.rounding(x, y, R), ROUNDING);
}

function _plain(residual) {
let value;
value = (((residual.value != null) && truth(math.isfinite(residual.value))) ? residual.value : null);
return bit_or(asdict(residual), new Map([["value", value], ["verdict", residual.verdict]]));
}

function least_times(trajectory) {
return (truth(trajectory.problem.has_closed_form) ? least_times__in_still_air(trajectory) : least_times__in_wind(trajectory));
}

function gradient_of(times) {
let T, bend, best, bound, cancelled, coarse, coarse_bend, corner, error, fine, h, sides, truncation;
best = null;
coarse = null;
[T, coarse_bend, corner] = iter([times.time(0, 0.0), math.inf, false]);
for (h of iter(times.steps)) {
if (((best != null) && gt(div(times.error(T, 0.0), h), best.bound))) {
break;
}
sides = list(iter(range(times.axes))).map((axis) => [sub(times.time(axis, h), T), sub(times.time(axis, neg(h)), T)]);
fine = tuple(list(iter(sides)).map((one) => iter(one)).map(([after, before]) => div(sub(after, before), mul(2.0, h))));
bend = div(math.hypot(...iter(list(iter(sides)).map((one) => iter(one)).map(([after, before]) => add(after, before)))), h);
if ((coarse != null)) {
truncation = math.hypot(...iter(list(iter(zip(fine, coarse))).map((one) => iter(one)).map(([a, b]) => sub(a, b))));
error = div(times.error(T, math.hypot(...iter(fine))), h);
bound = add(add(truncation, bend), error);
cancelled = ((best != null) && gt(bend, add(best.bound, mul(2.0, error))));
if (((best == null) || truth(cancelled) || lt(bound, best.bound))) {
[best, corner] = iter([Gradient(fine, bound), (gt(bend, mul(STRAIGHTENS, coarse_bend)) && gt(bend, mul(4.0, error)))]);
}
}
[coarse, coarse_bend] = iter([fine, bend]);
}
return (((best != null) && !truth(corner) && le(best.bound, mul(RESOLVED, math.hypot(...iter(best.slopes))))) ? best : null);
}

function* corner_residuals(equations, trajectory, accuracy, times) {
let adjoint, after, ahead, along, before, behind, bound, c, least, motions, off, slopes, start;
after = list(iter(range(times.axes))).map((axis) => one_sided(times, partial(times.time, axis)));
before = list(iter(range(times.axes))).map((axis) => one_sided(times, partial(_time_before, times, axis)));
motions = list(iter([-1, 0, 1])).map((u) => one_sided(times, partial(times.after, u)));
slopes = list(iter([...iter(after), ...iter(before), ...iter(motions)])).filter((slope) => (slope != null)).map((slope) => slope);
if (lt(len(slopes), add(mul(2, times.axes), 3))) {
return;
}
bound = max(list(iter(slopes)).map((slope) => slope.bound));
[start, c] = iter([trajectory.first, add(trajectory.lam, inner(trajectory.first.p, trajectory.first.w))]);
[adjoint, off] = iter([[start.p.real, start.p.imag, start.phi], 0.0]);
for ([along, ahead, behind] of rows(zip(sliced(adjoint, null, times.axes, null), slopes, sliced(slopes, times.axes, null, null)))) {
if (gt(add(ahead.value, behind.value), mul(2.0, bound))) {
return;
}
off = max(off, add(mul(c, ahead.value), along), sub(mul(c, behind.value), along));
}
if (eq(len(trajectory.pieces), 1)) {
yield Residual("gradient", equations.gradient, null, null, times.not_smooth());
} else {
yield Residual("gradient", equations.gradient, off, add(mul(abs(c), bound), accuracy.gradient), AT_CORNER);
}
least = min(list(iter(sliced(slopes, mul(2, times.axes), null, null))).map((slope) => slope.value));
yield Residual("bellman", equations.bellman, abs(add(1.0, least)), bound, AT_CORNER);
}

const InitialAdjoint = struct(class extends Tuple {
constructor(p, lam, phi) {
super();
this.p = p;
this.lam = lam;
this.phi = phi;

}
}, ["p", "lam", "phi"], 'InitialAdjoint');

function* switch_adjoints(start, pieces) {
let middle, piece;
for (piece of iter(pieces)) {
if (eq(piece.u, 0)) {
yield vanishing_at(start, pieces, piece, piece.e, 1.0);
}
}
if ((eq(len(pieces), 3) && truth(item(pieces, 1).u))) {
middle = item(pieces, 1);
yield vanishing_at(start, pieces, middle, mul(neg(middle.e), cmath.exp(mul(mul(new Complex(0.0, 0.5), middle.u), middle.t))), neg(math.cos(mul(0.5, middle.t))));
}
}

function vanishing_at(start, pieces, piece, p, lam) {
let elapsed;
elapsed = sum(list(iter(sliced(pieces, null, index_(pieces, piece), null))).map((before) => before.t));
return InitialAdjoint(p, lam, inner(p, mul(new Complex(0.0, 1.0), sub(sub(piece.q, start.q), mul(start.w, elapsed)))));
}

const HeldCircle = struct(class extends Values {
constructor(azimuth, way, R, w) {
super();
this.azimuth = azimuth;
this.way = way;
this.R = R;
this.w = w;

}
get times() { return cached(this, "times", () => {
let begins, widths;
const self = this;
widths = np.full(PIECES, div(math.tau, PIECES));
begins = add(self.azimuth, mul(mul(self.way, widths), np.arange(PIECES)));
return np.concatenate([[0.0], np.cumsum(hold_time(begins, widths, self.way, self.R, self.w))]);
}); }
time(width) {
let begin, found, piece, turns, within;
const self = this;
turns = np.floor(div(width, math.tau));
piece = np.floor(np.minimum(mul(sub(width, mul(math.tau, turns)), div(PIECES, math.tau)), sub(PIECES, 1.0))).astype(int);
begin = add(mul(math.tau, turns), mul(piece, div(math.tau, PIECES)));
within = hold_time(add(self.azimuth, mul(self.way, begin)), sub(width, begin), self.way, self.R, self.w);
found = add(add(mul(turns, item(self.times, -1)), item(self.times, piece)), within);
return found;
}
width(time) {
let _, high, left, low, middle, period, piece, turns;
const self = this;
period = float(item(self.times, -1));
turns = math.floor(div(time, period));
left = sub(time, mul(turns, period));
piece = min(sub(np.flatnonzero(le(self.times, left)).size, 1), sub(PIECES, 1));
[low, high] = iter([div(mul(piece, math.tau), PIECES), div(mul(add(piece, 1), math.tau), PIECES)]);
for (_ of iter(range(60))) {
middle = mul(0.5, add(low, high));
[low, high] = iter((lt(float(item(self.time(np.array([middle])), 0)), left) ? [middle, high] : [low, middle]));
}
return add(mul(math.tau, turns), mul(0.5, add(low, high)));
}
after(time) {
const self = this;
return HeldCircle(add(self.azimuth, mul(self.way, self.width(time))), self.way, self.R, self.w);
}
state() {
let crab, g, heading, out;
const self = this;
[g, heading] = iter(ground_speed(self.azimuth, self.way, self.w));
out = np.exp(mul(new Complex(0.0, 1.0), self.azimuth));
crab = float(mul(mul(mul(conjugate_(heading), new Complex(0.0, 1.0)), self.way), out).real);
return SlotState(complex(mul(self.R, out)), complex(heading), float(div(mul(mul(self.way, g), g), mul(self.R, crab))));
}
}, ["azimuth", "way", "R", "w"], 'HeldCircle');

function _first_unclear(start, heading, circle, widths, finest) {
let _, between, close, left, seen, unclear;
seen = watched(start, heading, circle, widths);
for (_ of iter(range(PASSES))) {
unclear = np.flatnonzero(invert(_excludes(seen)));
close = item(unclear, le(sub(item(seen.time, add(unclear, 1)), item(seen.time, unclear)), finest));
if (truth(close.size)) {
seen = Watched(...iter(list(iter(seen)).map((field) => sliced(field, null, add(item(close, 0), 2), null))));
unclear = item(unclear, lt(unclear, item(close, 0)));
}
if ((eq(unclear.size, 0) || gt(add(seen.time.size, unclear.size), MOST_TIMES))) {
break;
}
between = watched(start, heading, circle, mul(0.5, add(item(seen.width, unclear), item(seen.width, add(unclear, 1)))));
seen = Watched(...iter(list(iter(zip(seen, between))).map((one) => iter(one)).map(([old, new_]) => np.insert(old, add(unclear, 1), new_))));
}
left = np.flatnonzero(invert(_excludes(seen)));
return (truth(left.size) ? Stop(float(item(seen.width, item(left, 0))), float(item(seen.time, item(left, 0)))) : null);
}

const LowerBound = struct(class extends Tuple {
constructor(time, passed) {
super();
this.time = time;
this.passed = passed;

}
}, ["time", "passed"], 'LowerBound');

function _end_of_pass(start, heading, circle, begin, limit) {
let away, seen;
seen = watched(start, heading, circle, np.linspace(begin, limit, slot_check_SAMPLES));
away = np.flatnonzero(ge(sliced(seen.gap, 1, null, null), NEAR));
return (truth(away.size) ? float(item(seen.width, add(item(away, 0), 1))) : limit);
}

function _least_gap(start, heading, circle, begin, end) {
let _, after, at, before, best, finer, high, k, low, lowest, seen;
seen = watched(start, heading, circle, np.linspace(begin, end, slot_check_SAMPLES));
[before, after] = iter([np.concatenate([[np.inf], sliced(seen.gap, null, -1, null)]), np.concatenate([sliced(seen.gap, 1, null, null), [neg(np.inf)]])]);
lowest = np.flatnonzero(bit_and(le(seen.gap, before), le(seen.gap, after)));
best = (eq(lowest.size, 0) ? float(seen.gap.min()) : np.inf);
for (k of iter(sliced(item(lowest, np.argsort(item(seen.gap, lowest))), null, MINIMA, null))) {
[low, high] = iter([float(item(seen.width, max(sub(k, 1), 0))), float(item(seen.width, min(add(k, 1), sub(slot_check_SAMPLES, 1))))]);
for (_ of iter(range(ZOOMS))) {
finer = watched(start, heading, circle, np.linspace(low, high, 21));
[best, at] = iter([min(best, float(finer.gap.min())), int(finer.gap.argmin())]);
[low, high] = iter([float(item(finer.width, max(sub(at, 1), 0))), float(item(finer.width, min(add(at, 1), 20)))]);
}
}
return best;
}

const NearPass = struct(class extends Tuple {
constructor(begin, end, gap) {
super();
this.begin = begin;
this.end = end;
this.gap = gap;

}
}, ["begin", "end", "gap"], 'NearPass');

const WayOut = struct(class extends Tuple {
constructor(side, phase, hold, width, time) {
super();
this.side = side;
this.phase = phase;
this.hold = hold;
this.width = width;
this.time = time;

}
}, ["side", "phase", "hold", "width", "time"], 'WayOut');

function _check_length(out, scene) {
let fastest, longest;
fastest = div(add(1.0, math.hypot(scene.wx, scene.wy)), scene.R);
longest = max(out.width, mul(fastest, out.hold), mul(fastest, out.time));
if (gt(longest, MOST_HELD)) {
throw errors.OutOfRange(`the hold is too long: ${format(div(longest, math.tau), `.3g`)} turns; at most ${format(div(MOST_HELD, math.tau), `g`)} are planned`);
}
}

function _hold_after_longer_path(first, out, scene, problem) {
let bearing_deg, hold, least, next_s, soonest, time, unit_s;
[least, unit_s] = iter([kernel.least_width(out, scene), problem.time_unit_s]);
if ((le(first.width, least) || le(first.time, mul(out.time, add(1.0, SAME_TIME))))) {
return null;
}
hold = _hold_until(out.time, first, out, scene, problem);
if ((hold == null)) {
time = kernel.time_held(out.phase, least, scene.R, scene.wx, scene.wy);
bearing_deg = _join_bearing_deg(least, out, scene);
next_s = next_arrival_s(problem, problem.orbit.turn, mul(sub(out.time, time), unit_s), bearing_deg);
soonest = add(div(next_s, unit_s), time);
if (lt(soonest, mul(first.time, sub(1.0, SAME_TIME)))) {
hold = _hold_until(soonest, first, out, scene, problem);
}
}
return hold;
}

const leg_Hold = struct(class extends Tuple {
constructor(entry, width, time) {
super();
this.entry = entry;
this.width = width;
this.time = time;

}
}, ["entry", "width", "time"], 'leg_Hold');

function _exit_pose(orbit, out, scene, r) {
let _, c, s, x, y;
[x, y, c, s, _] = iter(kernel.hold_pose(out.phase, out.side, scene.R, scene.wx, scene.wy));
return Pose(add(orbit.east_m, mul(r, x)), add(orbit.north_m, mul(r, y)), heading_of(c, s));
}

function first_clear(fence, maneuvers, margin_m = null) {
let blocking, found, later_s, maneuver, ordered, tried;
arrays.unchecked("fence", fence, Fence);
ordered = sorted(maneuvers, { key: ((maneuver) => maneuver.duration_s) });
if (!truth(ordered)) {
throw errors.InvalidArgument("maneuvers", "has none to choose from");
}
blocking = new Map([]);
for ([tried, maneuver] of rows(enumerate(ordered, { start: 1 }))) {
found = fence.check(maneuver, margin_m);
if (truth(found.clear)) {
later_s = sub(maneuver.duration_s, item(ordered, 0).duration_s);
return ClearEntry(maneuver, found, later_s, tried, tuple(blocking), item(ordered, 0).duration_s);
}
set_item(blocking, item(found.breaches, 0).zone.name, null);
}
return ClearEntry(null, null, math.nan, len(ordered), tuple(blocking), item(ordered, 0).duration_s);
}

function zones_on_circle(fence, maneuver, margin_m) {
let closest, hold, names, near, path, side, sides, zones;
path = flown_path(maneuver);
hold = path.pieces.take([path.hold]);
sides = fence.signed_distances(float(item(hold.x, 0)), float(item(hold.y, 0)));
names = [];
for ([zones, closest, side] of rows(zip(_by_kind(fence), approach(fence, hold, margin_m), sides))) {
near = bit_or(le(closest.distance, add(margin_m, TOUCH_M)), lt(side, 0.0));
names = add(names, list(iter(zip(zones, near))).map((one) => iter(one)).filter(([zone, is_near]) => truth(is_near)).map(([zone, is_near]) => zone.name));
}
return tuple(names);
}

const _Search = struct(class extends Values {
constructor(fence, problem, margin_m) {
super();
let c, clearance_m, gap_m, s, share;
const self = this;
gap_m = (truth(problem.still) ? STILL_AIR_GAP_M : WIND_GAP_M);
[self._fence, self._problem, self._margin_m] = iter([fence, problem, margin_m]);
self._curves = curves_of(fence, problem.orbit, add(margin_m, gap_m));
self._touching = len(self._curves);
for (share of iter((truth(problem.still) ? [] : WIDER))) {
clearance_m = add(add(margin_m, gap_m), mul(share, problem.aircraft.turn_radius_m));
self._curves = add(self._curves, list(iter(curves_of(fence, problem.orbit, clearance_m))).filter((curve) => !truth(curve.joined)).map((curve) => curve));
}
self._air = clear_entry__air(fence, problem, margin_m, self._curves);
[c, s] = iter(heading_vector(problem.pose.heading_deg));
self._start = Pose2(problem.pose.east_m, problem.pose.north_m, math.atan2(s, c));
}
fastest(known, least_m) {
let best, is_late, maneuver, r, search;
const self = this;
[best, r] = iter([known, self._problem.aircraft.turn_radius_m]);
for (search of iter(clear_entry_PASSES)) {
for (maneuver of iter(self._maneuvers(search, ((best == null) ? math.inf : best.length_m)))) {
best = self._faster(best, maneuver);
}
if (((best != null) && lt(best.length_m, add(least_m, mul(clear_entry_LATE, r))))) {
break;
}
}
if (((best != null) && lt(best.length_m, add(least_m, mul(clear_entry_NEAR, r))))) {
return best;
}
is_late = ((best == null) || ge(best.length_m, add(least_m, mul(clear_entry_LATE, r))));
return self._without_contacts(best, (truth(is_late) ? mul(SLACK, r) : 0.0));
}
_without_contacts(best, slack_m) {
let least_m, path, search, shorter, step;
const self = this;
[search, least_m] = iter([PathSearch(self._air, self._start, self._problem.aircraft.turn_radius_m), math.inf]);
for (step of iter(LATTICE_STEPS)) {
path = search.over_lattice(step, ((best == null) ? least_m : min(least_m, add(best.length_m, slack_m))));
if (((path == null) || ((best != null) && gt(len(path.pieces), max(MOST_PIECES, len(best.segments)))))) {
continue;
}
least_m = path.length_m;
shorter = (le(len(path.pieces), MOST_PIECES) ? search.shortened(path) : path);
if (((best == null) || lt(shorter.length_m, sub(best.length_m, LEAST_GAIN_M)))) {
best = self._faster(best, self._maneuver(shorter.pieces, shorter.way));
}
}
return best;
}
_faster(best, maneuver) {
let faster;
const self = this;
faster = ((best == null) || lt(maneuver.duration_s, best.duration_s));
return ((truth(faster) && truth(self._fence.check(maneuver, self._margin_m).clear)) ? maneuver : best);
}
*_maneuvers(search, most_m) {
let chain, curves, moved, r, refined, rows_;
const self = this;
r = self._problem.aircraft.turn_radius_m;
refined = (truth(self._problem.still) ? search : 1);
curves = (gt(search, 1) ? self._curves : sliced(self._curves, null, self._touching, null));
rows_ = [...iter(rows_on(curves, r, refined)), ...iter(rows_without_straight(curves, ...iter(self._start), r))];
rows_ = add(rows_, rows_on_tangents(curves, ...iter(self._start), r));
for (chain of iter(self._chains(placed(self._curves, rows_), add(most_m, mul(SLACK, r)), mul(SLACK, r), MOST_CHAINS))) {
moved = self._moved(chain, refined);
yield self._maneuver(_merged(moved), int(item(moved.contacts.way, -1)));
}
}
_chains(contacts, most_m, slack_m, most) {
let allowed, clear, poses;
const self = this;
clear = clear_points(self._fence, contacts.x, contacts.y, self._margin_m);
allowed = contacts.take(item(clear.nonzero(), 0));
poses = (truth(self._problem.still) ? MOST_POSES : MOST_POSES_IN_WIND);
return ChainSearch(self._air, self._start, allowed, most_m, poses).chains(slack_m, most);
}
_moved(chain, refined) {
let k, near, rows_;
const self = this;
for (k of iter(range(1, add(HALVINGS, 1)))) {
rows_ = set_of(list(iter(range(len(chain.paths)))).flatMap((path) => list(iter(self._rows_near(chain, path, pow(0.5, k), refined))).map((row) => row)));
near = placed(self._curves, sorted(rows_));
chain = next(iter(self._chains(near, chain.length_m, 0.0, 1)), chain);
}
return self._tangent(chain);
}
_tangent(chain) {
let _, found, i, k, move, paths, r, rows_, share, tangent, way;
const self = this;
[r, tangent] = iter([self._problem.aircraft.turn_radius_m, chain]);
for (_ of iter(range(TANGENT_STEPS))) {
[rows_, paths] = iter([[], tangent.paths]);
for ([k, [i, share, way]] of rows(enumerate(rows_of(tangent.contacts)))) {
move = 0.0;
if ((lt(add(k, 1), len(paths)) && gt(item(item(paths, add(k, 1)), 0).radius_m, r))) {
move = neg(_turned(item(item(paths, k), 2)));
} else {
if ((lt(add(k, 1), len(paths)) && gt(item(item(paths, k), 0).radius_m, r))) {
move = _turned(item(item(paths, add(k, 1)), 0));
}
}
append_(rows_, [i, beside(item(self._curves, i), share, div(move, or(item(self._curves, i).width, () => math.inf))), way]);
}
found = self._chains(placed(self._curves, rows_), math.inf, 0.0, 1);
if ((!truth(found) || ne(len(item(found, 0).paths), len(paths)))) {
return chain;
}
tangent = item(found, 0);
}
return (lt(tangent.length_m, chain.length_m) ? tangent : chain);
}
*_rows_near(chain, k, step, refined) {
let curve, i, moves, share, way, width;
const self = this;
[i, share, way] = iter(item(rows_of(chain.contacts), k));
curve = item(self._curves, i);
width = div(step, curve.steps(self._problem.aircraft.turn_radius_m, refined));
moves = list(iter([-2, -1, 0, 1, 2])).map((m) => mul(m, width));
yield* iter(list(iter(moves)).map((move) => [i, beside(curve, share, move), way]));
}
_maneuver(pieces, way) {
let control, here, length_m, miss_m, now, problem, radius_m, segments, turn;
const self = this;
problem = self._problem;
segments = [];
[here, now] = iter([problem.pose, 0.0]);
for ([control, length_m, radius_m] of rows(pieces)) {
append_(segments, segment(here, now, item(clear_entry_LETTERS, control), length_m, problem.aircraft, problem.wind, radius_m));
[here, now] = iter([item(segments, -1).end, add(now, item(segments, -1).duration_s)]);
}
turn = (gt(way, 0) ? Turn.CCW : Turn.CW);
miss_m = abs(sub(problem.orbit.distance_m(here), problem.orbit.radius_m));
return Maneuver(problem.pose, problem.orbit, problem.aircraft, turn, tuple(segments), miss_m, problem.wind);
}
}, []);

function _least(distances, shares) {
let best, every;
every = np.stack(distances);
best = every.argmin({ axis: 0 });
return Nearest(every.min({ axis: 0 }), np.choose(best, shares));
}

function arc_edge_points(arcs, edges) {
let across, along, directions, distance, ends, ex, ey, h, length, qx, qy, r, shape, share, vx, vy;
[ex, ey] = iter([sub(edges.bx, edges.ax), sub(edges.by, edges.ay)]);
length = np.hypot(ex, ey);
[ex, ey] = iter([div(ex, length), div(ey, length)]);
[vx, vy] = iter([sub(edges.ax, arcs.x), sub(edges.ay, arcs.y)]);
h = sub(mul(ex, vy), mul(ey, vx));
across = np.clip(div(h, arcs.radius), -1.0, 1.0);
along = np.sqrt(mul(sub(1.0, across), add(1.0, across)));
r = np.maximum(np.hypot(vx, vy), np.finfo(float).tiny);
shape = np.broadcast_shapes(arcs.x.shape, edges.ax.shape);
ends = list(iter([0.0, 1.0])).map((share) => arcs.direction(share));
directions = [...iter(ends), [div(vx, r), div(vy, r)], [sub(mul(ex, along), mul(ey, across)), add(mul(ey, along), mul(ex, across))], [sub(mul(neg(ex), along), mul(ey, across)), add(mul(neg(ey), along), mul(ex, across))]];
[qx, qy] = iter(list(iter(zip(...iter(directions)))).map((values) => np.stack(list(iter(values)).map((value) => np.broadcast_to(value, shape)))));
share = arcs.share(qx, qy);
const unpacked1 = iter([0.0, 1.0]);
set_item(share, 0, unpacked1[0]);
set_item(share, 1, unpacked1[1]);
distance = np.where(le(share, 1.0), to_edge(add(arcs.x, mul(arcs.radius, qx)), add(arcs.y, mul(arcs.radius, qy)), edges), np.inf);
return [distance, share];
}

const Arcs = struct(class extends Tuple {
constructor(x, y, radius, nx, ny, u, angle) {
super();
this.x = x;
this.y = y;
this.radius = radius;
this.nx = nx;
this.ny = ny;
this.u = u;
this.angle = angle;

}
share(qx, qy) {
let turned;
const self = this;
turned = np.arctan2(mul(self.u, sub(mul(self.nx, qy), mul(self.ny, qx))), add(mul(self.nx, qx), mul(self.ny, qy)));
return div(np.where(lt(turned, 0.0), add(turned, mul(2.0, np.pi)), turned), np.maximum(self.angle, np.finfo(float).tiny));
}
direction(share) {
let c, s;
const self = this;
[c, s] = iter([np.cos(mul(share, self.angle)), mul(self.u, np.sin(mul(share, self.angle)))]);
return [sub(mul(self.nx, c), mul(self.ny, s)), add(mul(self.ny, c), mul(self.nx, s))];
}
}, ["x", "y", "radius", "nx", "ny", "u", "angle"], 'Arcs');

function chord_edge_points(ax, ay, bx, by, edges) {
let c, crosses, crossing, d, from_a, from_b, zero;
c = chord_to_point(ax, ay, bx, by, edges.ax, edges.ay);
d = chord_to_point(ax, ay, bx, by, edges.bx, edges.by);
[from_a, from_b] = iter([to_edge(ax, ay, edges), to_edge(bx, by, edges)]);
crossing = crossing_share(ax, ay, bx, by, edges);
crosses = np.where(ge(crossing, 0.0), 0.0, np.inf);
zero = np.zeros_like(from_a);
return [[from_a, from_b, c.distance, d.distance, crosses], [zero, add(zero, 1.0), c.share, d.share, crossing]];
}

const ChordToEdge = struct(class extends Tuple {
constructor(from_a, from_b, nearest) {
super();
this.from_a = from_a;
this.from_b = from_b;
this.nearest = nearest;

}
}, ["from_a", "from_b", "nearest"], 'ChordToEdge');

const Extremes = struct(class extends Tuple {
constructor(least, largest) {
super();
this.least = least;
this.largest = largest;

}
}, ["least", "largest"], 'Extremes');

function foot_share(x, y, ax, ay, bx, by) {
let along, ex, ey, length_2;
[ex, ey] = iter([sub(bx, ax), sub(by, ay)]);
length_2 = add(mul(ex, ex), mul(ey, ey));
along = add(mul(sub(x, ax), ex), mul(sub(y, ay), ey));
return np.clip(np.divide(along, length_2, { out: np.zeros(np.broadcast(along, length_2).shape), where: gt(length_2, 0.0) }), 0.0, 1.0);
}

function first_within(distances, shares, within_m) {
return np.where(le(np.stack(distances), within_m), np.stack(shares), np.inf).min({ axis: 0 });
}

function arc_circle_points(arcs, x, y, radius) {
let apart, c, directions, from_centre, qx, qy, s, share, towards_x, towards_y, vx, vy;
[vx, vy] = iter([sub(x, arcs.x), sub(y, arcs.y)]);
apart = np.maximum(np.hypot(vx, vy), NO_LENGTH_M);
[towards_x, towards_y] = iter([div(vx, apart), div(vy, apart)]);
c = np.clip(div(sub(add(pow(apart, 2), pow(arcs.radius, 2)), pow(radius, 2)), mul(mul(2.0, apart), arcs.radius)), -1.0, 1.0);
s = np.sqrt(mul(sub(1.0, c), add(1.0, c)));
directions = [...iter(list(iter([0.0, 1.0])).map((share) => arcs.direction(share))), [towards_x, towards_y], [neg(towards_x), neg(towards_y)], [sub(mul(towards_x, c), mul(towards_y, s)), add(mul(towards_y, c), mul(towards_x, s))], [add(mul(towards_x, c), mul(towards_y, s)), sub(mul(towards_y, c), mul(towards_x, s))]];
[qx, qy] = iter(list(iter(zip(...iter(directions)))).map((values) => np.stack(values)));
share = arcs.share(qx, qy);
const unpacked1 = iter([0.0, 1.0]);
set_item(share, 0, unpacked1[0]);
set_item(share, 1, unpacked1[1]);
from_centre = np.hypot(sub(mul(arcs.radius, qx), vx), sub(mul(arcs.radius, qy), vy));
return [np.where(le(share, 1.0), abs(sub(from_centre, radius)), np.inf), share];
}

function _disc(zone) {
return [zone.east_m, zone.north_m, zone.radius_m];
}

function chord_circle_points(ax, ay, bx, by, x, y, radius) {
let across, along, from_centre, half, length, near, share, zero;
near = chord_to_point(ax, ay, bx, by, x, y);
length = np.maximum(np.hypot(sub(bx, ax), sub(by, ay)), NO_LENGTH_M);
along = div(add(mul(sub(x, ax), sub(bx, ax)), mul(sub(y, ay), sub(by, ay))), length);
across = sub(pow(np.hypot(sub(x, ax), sub(y, ay)), 2), pow(along, 2));
half = np.sqrt(np.maximum(sub(pow(radius, 2), across), 0.0));
zero = np.zeros_like(near.share);
share = np.stack([zero, add(zero, 1.0), near.share, div(sub(along, half), length), div(add(along, half), length)]);
from_centre = np.hypot(sub(add(ax, mul(share, sub(bx, ax))), x), sub(add(ay, mul(share, sub(by, ay))), y));
return [np.where(bit_and(ge(share, 0.0), le(share, 1.0)), abs(sub(from_centre, radius)), np.inf), share];
}

function _from_circle(zone, chords) {
let at_a, at_b, near;
[at_a, at_b] = iter([signed_distance(zone, chords.ax, chords.ay), signed_distance(zone, chords.bx, chords.by)]);
if (truth(zone.inclusion)) {
return [np.minimum(at_a, at_b), at_a, at_b];
}
near = chord_to_point(chords.ax, chords.ay, chords.bx, chords.by, zone.east_m, zone.north_m);
return [sub(near.distance, zone.radius_m), at_a, at_b];
}

function _from_polygon(zone, chords) {
let c, deepest, found, lower, near, side_a, side_b, sides;
c = chords.columns();
found = chord_to_edge(c.ax, c.ay, c.bx, c.by, zone._edges);
sides = polygon_sign(zone, np.append(chords.ax, chords.bx), np.append(chords.ay, chords.by));
[side_a, side_b] = iter(np.split(sides, 2));
near = found.nearest.distance.min({ axis: 1 });
deepest = np.maximum(found.from_a, found.from_b).min({ axis: 1 });
lower = np.where(bit_and(gt(side_a, 0.0), gt(near, chords.off)), near, neg(deepest));
return [lower, mul(side_a, found.from_a.min({ axis: 1 })), mul(side_b, found.from_b.min({ axis: 1 }))];
}

const Segment = struct(class extends Values {
constructor(letter, start_s, duration_s, length_m, curvature_per_m, start, end) {
super();
this.letter = letter;
this.start_s = start_s;
this.duration_s = duration_s;
this.length_m = length_m;
this.curvature_per_m = curvature_per_m;
this.start = start;
this.end = end;

}
}, ["letter", "start_s", "duration_s", "length_m", "curvature_per_m", "start", "end"], 'Segment');

const Entry = struct(class extends Tuple {
constructor(side, word, t1, t2, t3) {
super();
this.side = side;
this.word = word;
this.t1 = t1;
this.t2 = t2;
this.t3 = t3;

}
}, ["side", "word", "t1", "t2", "t3"], 'Entry');

function* _transversal(start, pieces, switched) {
let across, along, angle, e, k, turned;
[turned, [e, k]] = iter([switched.e, _end(start, pieces)]);
across = sub(inner(mul(new Complex(0.0, 1.0), turned), add(e, start.w)), mul(k, inner(mul(new Complex(0.0, 1.0), turned), e)));
along = add(inner(turned, add(e, start.w)), mul(k, sub(1.0, inner(turned, e))));
for (angle of iter([math.atan2(neg(along), across), math.atan2(along, neg(across))])) {
yield vanishing_at(start, pieces, switched, mul(turned, cmath.exp(mul(new Complex(0.0, 1.0), angle))), math.cos(angle));
}
}

function* _of_single_arc(start, pieces) {
let e, i, k, lam, longest, p;
[longest, [e, k]] = iter([max(pieces, { key: ((piece) => piece.t) }), _end(start, pieces)]);
for (i of iter(range(SCANNED_DIRECTIONS))) {
p = cmath.exp(div(mul(mul(new Complex(0.0, 2.0), math.pi), i), SCANNED_DIRECTIONS));
lam = sub(inner(p, e), div(inner(p, add(e, start.w)), k));
yield InitialAdjoint(p, lam, mul(longest.u, sub(lam, inner(p, start.e))));
}
}

const PieceState = struct(class extends Tuple {
constructor(q, e, psi, phi) {
super();
this.q = q;
this.e = e;
this.psi = psi;
this.phi = phi;

}
get reduced() {
const self = this;
return mul(self.q, conjugate_(self.e));
}
get x() {
const self = this;
return self.reduced.real;
}
get y() {
const self = this;
return self.reduced.imag;
}
get psi1() {
const self = this;
return self.psi.real;
}
get psi2() {
const self = this;
return self.psi.imag;
}
}, ["q", "e", "psi", "phi"], 'PieceState');

function _optimum_alone(...arguments_) {
let best;
best = kernel.optimum(...iter(arguments_));
return ((best == null) ? [] : [best]);
}

function _fastest_alone(problem) {
return [kernel.wind_search_fastest(problem)];
}

const Units = struct(class extends Tuple {
constructor(delta, epsilon) {
super();
this.delta = delta;
this.epsilon = epsilon;

}
}, ["delta", "epsilon"], 'Units');

function least_times__in_still_air(trajectory) {
let R, by_heading, fastest, not_smooth, problem, rounded, side, tolerance, x, y;
problem = trajectory.problem.reduced();
[x, y, R, side, tolerance] = iter(problem);
rounded = kernel.rounding(x, y, R);
fastest = function (axis, step) {
return kernel.optimum(add(x, mul(step, eq(axis, 0))), add(y, mul(step, eq(axis, 1))), R, side, tolerance);
};
by_heading = function (slopes) {
let by_x, by_y;
[by_x, by_y] = iter(slopes);
return sub(mul(by_x, y), mul(by_y, x));
};
not_smooth = function () {
let around, h, words;
h = min(STEPS_IN_STILL_AIR);
around = list(iter([[0, 0.0], [0, h], [0, neg(h)], [1, h], [1, neg(h)]])).map((one) => iter(one)).map(([axis, step]) => fastest(axis, step));
words = dict.fromkeys(list(iter(around)).map((m) => `${str(letters(m.word))} ${str(lower_(name_of(kernel.Side, m.side)))}`));
return `T has a corner or a jump here, or bends too sharply: ${str(join_(", ", words))}`;
};
return LeastTimes(2, list(iter(STEPS_IN_STILL_AIR)).filter((h) => le(h, _widest_step(trajectory, problem))).map((h) => h), ((axis, step) => kernel.entry_duration(fastest(axis, step))), ((u, step) => kernel.entry_duration(kernel.optimum(...iter(kernel.flow(x, y, u, step)), R, side, tolerance))), ((T, slope) => mul(mul(2.0, rounded), add(1.0, slope))), by_heading, add(1.0, math.hypot(x, y)), not_smooth);
}

function least_times__in_wind(trajectory) {
let after, by_heading, problem, time, w;
problem = replace(trajectory.problem.in_wind(), { tolerance: 0.0 });
w = complex(problem.wx, problem.wy);
time = function (axis, step) {
let e, x, y;
e = mul(complex(problem.c, problem.s), (eq(axis, 2) ? cmath.exp(mul(new Complex(0.0, 1.0), step)) : 1.0));
[x, y] = iter([add(problem.x, mul(step, eq(axis, 0))), add(problem.y, mul(step, eq(axis, 1)))]);
return kernel.time_of(kernel.wind_search_fastest(replace(problem, { x: x, y: y, c: e.real, s: e.imag })));
};
after = function (u, step) {
let _, e, piece, q;
piece = FlownPiece(u, step, complex(problem.x, problem.y), complex(problem.c, problem.s), 0.0, add(1.0, new Complex(0.0, 0.0)), w);
[q, e, _, _] = iter(piece.end);
return kernel.time_of(kernel.wind_search_fastest(replace(problem, { x: q.real, y: q.imag, c: e.real, s: e.imag })));
};
by_heading = function (slopes) {
let _, slope;
[_, _, slope] = iter(slopes);
return slope;
};
return LeastTimes(3, STEPS_IN_WIND, time, after, ((T, slope) => mul(mul(2.0, WIND_TIE_TOLERANCE), add(add(1.0, problem.R), T))), by_heading, 4.0, (() => "T has a corner here, or bends too sharply"));
}

const Gradient = struct(class extends Tuple {
constructor(slopes, bound) {
super();
this.slopes = slopes;
this.bound = bound;

}
}, ["slopes", "bound"], 'Gradient');

function one_sided(times, later) {
let T, best, bound, coarse, h, value;
[best, coarse, T] = iter([null, math.inf, times.time(0, 0.0)]);
for (h of iter(times.steps)) {
value = div(sub(later(h), T), h);
bound = add(mul(2.42, abs(sub(value, coarse))), div(times.error(T, abs(value)), h));
if (((best != null) && gt(div(times.error(T, 0.0), h), best.bound))) {
break;
}
best = (((best == null) || lt(bound, best.bound)) ? Slope(value, bound) : best);
coarse = value;
}
return (((best != null) && le(best.bound, mul(RESOLVED, max(1.0, abs(best.value))))) ? best : null);
}

function _time_before(times, axis, h) {
return times.time(axis, neg(h));
}

function hold_time(azimuth, width, way, R, w) {
let _, g, node, total, weight;
total = np.zeros_like(add(azimuth, width));
for ([node, weight] of rows(zip(arrays.NODES, arrays.WEIGHTS))) {
[g, _] = iter(ground_speed(add(azimuth, mul(mul(mul(way, width), 0.5), add(1.0, node))), way, w));
total = add(total, div(mul(0.5, weight), g));
}
return mul(mul(R, width), total);
}

function ground_speed(azimuth, way, w) {
let across, along, crab, track;
track = mul(mul(new Complex(0.0, 1.0), way), np.exp(mul(new Complex(0.0, 1.0), azimuth)));
[across, along] = iter([mul(w, conjugate_(track)).imag, mul(w, conjugate_(track)).real]);
crab = np.sqrt(sub(1.0, pow(across, 2)));
return [add(crab, along), mul(track, sub(crab, mul(new Complex(0.0, 1.0), across)))];
}

const SlotState = struct(class extends Tuple {
constructor(place, heading, control) {
super();
this.place = place;
this.heading = heading;
this.control = control;

}
}, ["place", "heading", "control"], 'SlotState');

function watched(start, heading, circle, width) {
let _, azimuth, beyond, gap, place, slot_heading, time;
time = circle.time(width);
azimuth = add(circle.azimuth, mul(circle.way, width));
[_, slot_heading] = iter(ground_speed(azimuth, circle.way, circle.w));
place = div(sub(sub(mul(circle.R, np.exp(mul(new Complex(0.0, 1.0), azimuth))), mul(circle.w, time)), start), heading);
beyond = sub(np.abs(place), time);
gap = distance(place, np.angle(div(slot_heading, heading)), time);
return Watched(width, time, gap, np.maximum(div(gap, CLOSING), mul(0.5, beyond)));
}

function _excludes(seen) {
return ge(add(sliced(seen.time, null, -1, null), sliced(seen.clear, null, -1, null)), sliced(seen.time, 1, null, null));
}

const Watched = struct(class extends Tuple {
constructor(width, time, gap, clear) {
super();
this.width = width;
this.time = time;
this.gap = gap;
this.clear = clear;

}
}, ["width", "time", "gap", "clear"], 'Watched');

const Stop = struct(class extends Tuple {
constructor(width, time) {
super();
this.width = width;
this.time = time;

}
}, ["width", "time"], 'Stop');

function _hold_until(exit_time, first, out, scene, problem) {
let entry, join_s, k, least, time, width;
least = kernel.least_width(out, scene);
for (k of iter(range(1, add(LONGER_PATHS, 1)))) {
width = max(least, (lt(k, LONGER_PATHS) ? sub(first.width, mul(k, BETWEEN_JOINS)) : least));
time = kernel.time_held(out.phase, width, scene.R, scene.wx, scene.wy);
if (lt(time, exit_time)) {
join_s = mul(sub(exit_time, time), problem.time_unit_s);
entry = arrival_in(problem, problem.orbit.turn, join_s, _join_bearing_deg(width, out, scene));
if ((entry != null)) {
return leg_Hold(entry, width, time);
}
}
if (eq(width, least)) {
break;
}
}
return null;
}

function _join_bearing_deg(width, out, scene) {
let _, x, y;
[x, y, _, _, _] = iter(kernel.hold_pose(sub(out.phase, width), out.side, scene.R, scene.wx, scene.wy));
return math.degrees(math.atan2(x, y));
}

function next_arrival_s(problem, turn, time_s, bearing_deg) {
let placed;
placed = placed_arrival(problem, turn, time_s, bearing_deg);
return mul(next_time(placed.arrival, placed.time), problem.time_unit_s);
}

const ClearEntry = struct(class extends Tuple {
constructor(maneuver, check, later_s, tried, blocking, least_s = 0.0, searched = false) {
super();
this.maneuver = maneuver;
this.check = check;
this.later_s = later_s;
this.tried = tried;
this.blocking = blocking;
this.least_s = least_s;
this.searched = searched;

}
get is_fastest() {
const self = this;
return and(and((self.maneuver != null), () => eq(self.tried, 1)), () => !truth(self.searched));
}
get sentence() {
let later, what;
const self = this;
if ((self.maneuver == null)) {
return self._refusal;
}
if (truth(self.is_fastest)) {
return "The fastest entry is clear.";
}
later = (ge(self.later_s, SAME_TIME_S) ? `joins ${format(self.later_s, `.1f`)} s later` : "is as fast");
what = (truth(self.searched) ? "The fastest clear entry found" : "The first candidate that is clear");
return `${str(what)} ${str(later)}: ${str(self.maneuver)}`;
}
get _refusal() {
let block, candidates, zones;
const self = this;
[zones, block] = iter([join_(" and ", map(repr, self.blocking)), (eq(len(self.blocking), 1) ? "blocks" : "block")]);
if (eq(self.least_s, math.inf)) {
return `No entry is clear: ${str(zones)} ${str(block)} the circle itself, or every way to it.`;
}
candidates = (eq(self.tried, 1) ? "the candidate" : `the ${str(self.tried)} candidates`);
if (truth(self.searched)) {
return `No entry found, though there may be one: ${str(zones)} ${str(block)} ${str(candidates)}.`;
}
return `No entry found: ${str(zones)} ${str(block)} ${str(candidates)}, and no other path was searched.`;
}
}, ["maneuver", "check", "later_s", "tried", "blocking", "least_s", "searched"], 'ClearEntry');

function curves_of(fence, orbit, clearance_m) {
let circle, found, ways;
found = list(iter(fence.zones)).flatMap((zone) => list(iter(_zone_curves(zone, clearance_m))).map((curve) => curve));
ways = get_(new Map([[Turn.CW, [-1]], [Turn.CCW, [1]]]), orbit.turn, [1, -1]);
circle = Curve(orbit.east_m, orbit.north_m, orbit.radius_m, 0.0, math.tau, 0.0, 0.0, ways, true);
return [...iter(found), circle, replace(circle, { anywhere: true })];
}

function clear_entry__air(fence, problem, margin_m, curves) {
return (truth(problem.still) ? StillAir(fence, problem, margin_m, curves) : SteadyWind(fence, problem, margin_m));
}

const Pose2 = struct(class extends Tuple {
constructor(x, y, heading) {
super();
this.x = x;
this.y = y;
this.heading = heading;

}
}, ["x", "y", "heading"], 'Pose2');

const PathSearch = struct(class extends Values {
constructor(air, start, radius_m) {
super();
const self = this;
[self._air, self._start, self._r] = iter([air, start, radius_m]);
}
least(poses) {
let contacts, none, unknown;
const self = this;
[none, unknown] = iter([np.zeros(poses.x.size, bool), poses.x]);
contacts = Contacts(unknown, unknown, unknown, poses.x, poses.y, unknown, none, none);
return self._air.least_lengths(contacts, poses.heading);
}
endings(poses, flown) {
let clear, good, length, words;
const self = this;
words = self._air.fastest_entries(poses);
length = add(flown, words.length.sum({ axis: 1 }));
good = item(np.isfinite(length).nonzero(), 0);
clear = np.zeros(length.size, bool);
set_item(clear, good, self._air.are_clear(_taken(poses, good), words.take(good)));
return [words, np.where(clear, length, math.inf)];
}
one_piece(start, control, length) {
let words, zero;
const self = this;
zero = np.zeros(length.size);
words = Words(np.arange(length.size), np.stack([add(zero, control), zero, zero], { axis: -1 }), np.stack([length, zero, zero], { axis: -1 }), np.full([length.size, 3], self._r));
return [self._air.are_clear(start, words), self._air.flown(start, item(words.control, [slice(null, null), 0]), length)];
}
over_lattice(step, most_m) {
const self = this;
return _Lattice(self, self._start, self._r, step).path(most_m);
}
shortened(path) {
let _, before, changed, free, shorter;
const self = this;
shorter = path;
for (_ of iter(range(MOST_ROUNDS))) {
before = shorter;
for (free of iter(range(max(1, sub(len(before.pieces), MOST_ENTRY)), len(before.pieces)))) {
changed = self._changed(before, free);
shorter = (lt(changed.length_m, shorter.length_m) ? changed : shorter);
}
if (lt(sub(before.length_m, shorter.length_m), mul(LAST_CHANGE, self._r))) {
break;
}
}
return shorter;
}
_changed(path, free) {
let best, change, controls, found, lengths, row, sweep, tried;
const self = this;
lengths = np.array(list(iter(sliced(path.pieces, null, free, null))).map((piece) => piece.length_m));
controls = list(iter(sliced(path.pieces, null, free, null))).map((piece) => piece.control);
[sweep, change, best] = iter([0, mul(FIRST_CHANGE, self._r), path]);
while ((gt(change, mul(LAST_CHANGE, self._r)) && lt(sweep, MOST_SWEEPS))) {
tried = np.maximum(add(lengths, mul(change, _moves(free, sweep))), 0.0);
sweep = add(sweep, 1);
found = self._shortest(controls, tried, sub(best.length_m, mul(ENOUGH, change)));
if ((found == null)) {
change = mul(change, 0.5);
} else {
[best, row] = iter(found);
lengths = item(tried, row);
}
}
return best;
}
_shortest(controls, lengths, most_m) {
let _, control, first, good, i, k, length, r, row, starts, words, zero;
const self = this;
[zero, r] = iter([np.zeros(item(lengths.shape, 0)), self._r]);
starts = [_poses(...iter(list(iter(self._start)).map((value) => add(zero, value))))];
for ([k, control] of rows(enumerate(controls))) {
append_(starts, self._air.flown(item(starts, -1), add(zero, control), item(lengths, [slice(null, null), k])));
}
i = item(lt(add(lengths.sum({ axis: 1 }), self.least(item(starts, -1))), most_m).nonzero(), 0);
for ([k, control] of rows(enumerate(controls))) {
[good, _] = iter(self.one_piece(_taken(item(starts, k), i), control, item(lengths, [i, k])));
i = item(i, good);
}
if (!truth(i.size)) {
return null;
}
[words, length] = iter(self.endings(_taken(item(starts, -1), i), item(lengths, i).sum({ axis: 1 })));
k = int(length.argmin());
if (ge(item(length, k), most_m)) {
return null;
}
row = int(item(i, k));
first = list(iter(zip(controls, tolist_(item(lengths, row))))).map((one) => iter(one)).map(([u, length]) => Piece(u, float(length), r));
return [path_with(first, words, k, float(item(length, k))), row];
}
}, []);

function rows_on(curves, turn_radius_m, refined) {
let curve, i, n, rows_, shares;
rows_ = [];
for ([i, curve] of rows(enumerate(curves))) {
n = curve.steps(turn_radius_m, refined);
shares = (truth(curve.closed) ? list(iter(range(n))).map((k) => div(k, n)) : list(iter(range(add(n, 1)))).map((k) => div(k, n)));
rows_ = add(rows_, list(iter(shares)).flatMap((share) => list(iter(curve.ways)).map((way) => [i, share, way])));
}
return rows_;
}

function rows_without_straight(curves, x, y, angle, radius_m) {
let circle, cx, cy, distance, k, row, rows_, tx, ty, u, way;
rows_ = [];
for (u of iter([1, -1])) {
[cx, cy] = iter([add(x, mul(mul(u, radius_m), math.sin(angle))), sub(y, mul(mul(u, radius_m), math.cos(angle)))]);
rows_ = add(rows_, list(iter(_turns_at(curves, u, cx, cy, mul(2.0, radius_m), radius_m))).map((one) => iter(one)).map(([row, _0, _]) => row));
for ([k, circle] of rows(enumerate(curves))) {
for (way of iter(((truth(circle.joined) && !truth(circle.anywhere)) ? circle.ways : []))) {
distance = sub(circle.radius, mul(mul(u, way), radius_m));
for ([row, tx, ty] of rows(_turns_at(curves, u, circle.x, circle.y, distance, radius_m))) {
rows_ = add(rows_, [row, [k, div(mod(math.atan2(sub(ty, circle.y), sub(tx, circle.x)), math.tau), math.tau), way]]);
}
}
}
}
return rows_;
}

function rows_on_tangents(curves, x, y, angle, radius_m) {
let curve, cx, cy, i, k, normal, other, rows_, share, to, u, way, wide;
wide = list(iter(enumerate(curves))).map((one) => iter(one)).filter(([i, curve]) => (gt(curve.radius, radius_m) && gt(curve.width, 0.0))).map(([i, curve]) => [i, curve]);
wide = list(iter(wide)).map((one) => iter(one)).filter(([i, curve]) => !truth(curve.joined)).map(([i, curve]) => [i, curve]);
rows_ = [];
for ([i, curve] of rows(wide)) {
for (way of iter(curve.ways)) {
for (u of iter([1, -1])) {
[cx, cy] = iter([sub(x, mul(mul(u, radius_m), math.sin(angle))), add(y, mul(mul(u, radius_m), math.cos(angle)))]);
rows_ = add(rows_, list(iter(_tangents(cx, cy, radius_m, u, curve, way))).map((one) => iter(one)).map(([_0, to]) => [i, to, way]));
}
for ([k, other] of rows(wide)) {
for (u of iter((ne(k, i) ? other.ways : []))) {
for ([normal, to] of rows(_tangents(other.x, other.y, other.radius, u, curve, way))) {
share = div(mod(sub(normal, other.a), math.tau), other.width);
rows_ = add(rows_, (le(share, 1.0) ? [[i, to, way], [k, share, u]] : []));
}
}
}
}
}
return rows_;
}

function placed(curves, rows_) {
let a, anywhere, dx, dy, indices, joined, normal, places, radius, shares, ways, width, x, y;
[indices, shares, ways] = iter(list(iter(zip(...iter(rows_)))).map((column) => np.array(column)));
[x, y, radius, a, width, dx, dy] = iter(item(np.array(list(iter(curves)).map((curve) => sliced(curve, null, 7, null))), indices).T);
normal = add(a, mul(shares, width));
places = [add(add(x, mul(radius, np.cos(normal))), mul(shares, dx)), add(add(y, mul(radius, np.sin(normal))), mul(shares, dy))];
[joined, anywhere] = iter(list(iter(["joined", "anywhere"])).map((name) => item(np.array(list(iter(curves)).map((curve) => curve[name])), indices)));
return Contacts(indices, shares, ways, ...iter(places), add(normal, mul(ways, mul(0.5, math.pi))), joined, anywhere);
}

function _merged(chain) {
let merged, piece;
merged = [];
for (piece of iter(list(iter(chain.paths)).flatMap((path) => list(iter(path)).map((piece) => piece)))) {
if (lt(piece.length_m, NO_PIECE_M)) {
continue;
}
if ((truth(merged) && eq([item(merged, -1).control, item(merged, -1).radius_m], [piece.control, piece.radius_m]))) {
append_(merged, replace(piece, { length_m: add(piece.length_m, pop_(merged).length_m) }));
} else {
append_(merged, piece);
}
}
return merged;
}

function clear_points(fence, east_m, north_m, margin_m) {
let clear, zone;
clear = np.ones(east_m.size, bool);
for (zone of iter(fence.zones)) {
clear = bit_and(clear, gt(signed_distance(zone, east_m, north_m), margin_m));
}
return clear;
}

const ChainSearch = struct(class extends Values {
constructor(air, start, contacts, most_m, most_poses) {
super();
const self = this;
[self._air, self._start, self._contacts] = iter([air, start, contacts]);
self._headings = air.headings(contacts);
self._least = air.least_lengths(contacts, self._headings);
[self._most_m, self._most_poses] = iter([most_m, most_poses]);
self._length = np.full(add(contacts.x.size, 1), math.inf);
self._parent = mul([null], add(contacts.x.size, 1));
self._heap = [];
self._expansions = [];
}
chains(slack_m, most) {
let bound, chain, expansion, found, i, k, to, touched, until;
const self = this;
found = new Map([]);
set_item(self._length, -1, 0.0);
self._expand(self._contacts.x.size);
until = self._most_m;
while ((truth(self._heap) && lt(len(found), most))) {
[bound, k] = iter(heappop(self._heap));
if ((ge(bound, until) || gt(len(self._expansions), self._most_poses))) {
break;
}
expansion = item(self._expansions, k);
i = expansion.next;
to = int(item(expansion.words.to, i));
if (eq(item(self._length, to), math.inf)) {
if (eq(item(expansion.clear, i), UNKNOWN)) {
self._check(expansion);
}
if (eq(item(expansion.clear, i), CLEAR)) {
if (truth(item(self._contacts.joined, to))) {
chain = self._chain(expansion, i, to);
until = min(until, add(chain.length_m, slack_m));
touched = _touched(chain);
if (!has(touched, found)) {
set_item(found, touched, chain);
}
} else {
set_item(self._length, to, self._length_of(expansion, i));
set_item(self._parent, to, [expansion, i]);
self._expand(to);
}
}
}
expansion.next = add(expansion.next, 1);
self._push(k);
}
return sorted(values_(found), { key: ((chain) => chain.length_m) });
}
_pose(node) {
const self = this;
if (eq(node, self._contacts.x.size)) {
return self._start;
}
return Pose2(float(item(self._contacts.x, node)), float(item(self._contacts.y, node)), float(item(self._headings, node)));
}
_expand(node) {
let at, bound, order, words;
const self = this;
at = (eq(node, self._contacts.x.size) ? null : node);
words = self._air.words(self._pose(node), at, self._contacts, self._headings);
bound = add(add(item(self._length, node), _cost(words)), item(self._least, words.to));
order = np.argsort(bound, { kind: "stable" });
order = item(order, bit_and(lt(item(bound, order), self._most_m), eq(item(self._length, item(words.to, order)), math.inf)));
append_(self._expansions, _Expansion(node, item(bound, order), words.take(order), np.full(order.size, UNKNOWN)));
self._push(sub(len(self._expansions), 1));
}
_push(k) {
let expansion;
const self = this;
expansion = item(self._expansions, k);
if (lt(expansion.next, expansion.bound.size)) {
heappush(self._heap, [float(item(expansion.bound, expansion.next)), k]);
}
}
_check(expansion) {
let chosen, open_, rest;
const self = this;
rest = slice(expansion.next, null);
open_ = bit_and(eq(item(self._length, item(expansion.words.to, rest)), math.inf), eq(item(expansion.clear, rest), UNKNOWN));
chosen = add(sliced(item(open_.nonzero(), 0), null, BATCH, null), expansion.next);
set_item(expansion.clear, chosen, self._air.are_clear(self._pose(expansion.node), expansion.words.take(chosen)));
}
_length_of(expansion, i) {
const self = this;
return float(add(item(self._length, expansion.node), item(_cost(expansion.words.take([i])), 0)));
}
_chain(expansion, i, to) {
let before, columns, k, last, nodes, paths, words;
const self = this;
[nodes, paths, last] = iter([[to], [], [expansion, i]]);
while (truth(true)) {
[words, k] = iter([item(last, 0).words, item(last, 1)]);
columns = [item(words.control, k), item(words.length, k), item(words.radius, k)];
append_(paths, tuple(list(iter(zip(...iter(columns)))).map((piece) => Piece(...iter(map(float, piece))))));
before = item(self._parent, item(last, 0).node);
if ((before == null)) {
break;
}
append_(nodes, item(last, 0).node);
last = before;
}
return Chain(self._length_of(expansion, i), tuple(reversed(paths)), self._contacts.take(sliced(nodes, null, null, -1)));
}
}, []);

function rows_of(contacts) {
return list(zip(tolist_(contacts.curve), tolist_(contacts.share), tolist_(contacts.way)));
}

function _turned(piece) {
return div(mul(piece.control, piece.length_m), piece.radius_m);
}

function beside(curve, share, by) {
return (truth(curve.closed) ? mod(add(share, by), 1.0) : min(max(add(share, by), 0.0), 1.0));
}

function crossing_share(ax, ay, bx, by, edges) {
let across, along, cross, crosses, dx, dy, ex, ey, px, py, safe;
[dx, dy, ex, ey] = iter([sub(bx, ax), sub(by, ay), sub(edges.bx, edges.ax), sub(edges.by, edges.ay)]);
[px, py] = iter([sub(edges.ax, ax), sub(edges.ay, ay)]);
cross = sub(mul(dx, ey), mul(dy, ex));
safe = np.where(eq(cross, 0.0), 1.0, cross);
[along, across] = iter([div(sub(mul(px, ey), mul(py, ex)), safe), div(sub(mul(px, dy), mul(py, dx)), safe)]);
crosses = bit_and(bit_and(bit_and(bit_and(ne(cross, 0.0), ge(along, 0.0)), le(along, 1.0)), ge(across, 0.0)), le(across, 1.0));
return np.where(crosses, along, -1.0);
}

function signed_distance(zone, east_m, north_m) {
let outside;
if (truth(isinstance(zone, CircleZone))) {
outside = sub(np.hypot(sub(east_m, zone.east_m), sub(north_m, zone.north_m)), zone.radius_m);
return (truth(zone.inclusion) ? neg(outside) : outside);
}
return mul(to_edge(item(east_m, [slice(null, null), null]), item(north_m, [slice(null, null), null]), zone._edges).min({ axis: 1 }), polygon_sign(zone, east_m, north_m));
}

function polygon_sign(zone, east_m, north_m) {
let inside;

inside = shapely.contains_xy(zone._polygon, east_m, north_m);
return np.where(eq(inside, zone.inclusion), 1.0, -1.0);
}

function _end(start, pieces) {
let _, last;
[_, last] = with_middle(pieces, 0, 1);
return [last.end.e, end_rate(start, last.end.q, last.end.e, last.u)];
}

const LeastTimes = struct(class extends Tuple {
constructor(axes, steps, time, after, error, by_heading, motion_size, not_smooth) {
super();
this.axes = axes;
this.steps = steps;
this.time = time;
this.after = after;
this.error = error;
this.by_heading = by_heading;
this.motion_size = motion_size;
this.not_smooth = not_smooth;

}
}, ["axes", "steps", "time", "after", "error", "by_heading", "motion_size", "not_smooth"], 'LeastTimes');

function _widest_step(trajectory, problem) {
let _, parallel, turning;
turning = math.inf;
if ((truth(trajectory.opposed) || eq(len(trajectory.pieces), 1))) {
[_, parallel] = with_middle(or(trajectory.opposed, () => trajectory.pieces), 0, 1);
turning = abs(parallel.q);
}
return mul(0.25, min(turning, clearance(problem)));
}

const Slope = struct(class extends Tuple {
constructor(value, bound) {
super();
this.value = value;
this.bound = bound;

}
}, ["value", "bound"], 'Slope');

function distance(place, angle, t) {
let arc_end, best, other, same, short, turned, u;
best = add(np.abs(place), np.inf);
for (u of iter([1.0, -1.0])) {
turned = mod(mul(u, angle), math.tau);
[arc_end, short] = iter([mul(mul(new Complex(0.0, 1.0), u), sub(1.0, np.exp(mul(mul(new Complex(0.0, 1.0), u), t)))), np.abs(sub(mod(add(sub(turned, t), math.pi), math.tau), math.pi))]);
best = np.minimum(best, np.maximum(np.abs(sub(place, arc_end)), mul(mul(0.5, CLOSING), short)));
same = sub(place, mul(mul(new Complex(0.0, 1.0), u), sub(1.0, np.exp(mul(new Complex(0.0, 1.0), angle)))));
other = sub(place, mul(mul(new Complex(0.0, 1.0), u), add(1.0, np.exp(mul(new Complex(0.0, 1.0), angle)))));
best = np.minimum(best, _beside_same(same, u, turned, t));
best = np.fmin(best, _beside_other(other, u, turned, t));
best = np.minimum(best, _beside_three_arcs(same, u, turned, t));
}
return best;
}

function arrival_in(problem, turn, time_s, bearing_deg) {
let path;
path = _path(placed_arrival(problem, turn, time_s, bearing_deg));
return ((path == null) ? null : _maneuver(problem, path, turn, time_s, bearing_deg));
}

function placed_arrival(problem, turn, time_s, bearing_deg) {
let R, _, arrival, c, c0, px, py, s, s0, side, time, wx, wy, x, y;
[x, y, c0, s0, R, side, wx, wy, _] = iter(problem.with_turn(turn).in_wind());
time = div(time_s, problem.time_unit_s);
if (gt(time, LONGEST)) {
throw errors.InvalidArgument("time_s", `is ${format(time_s, `g`)}: it must be at most ${format(mul(LONGEST, problem.time_unit_s), `.4g`)} s`);
}
[px, py, c, s, _] = iter(kernel.hold_pose(kernel.phase_of(...iter(heading_vector(bearing_deg)), side, wx, wy), side, R, wx, wy));
arrival = Arrival(Ends(c0, s0, sub(px, x), sub(py, y), c, s), wx, wy);
return PlacedArrival(turn, arrival, time, div(kernel.rounding(x, y, add(R, time)), sub(1.0, kernel.length(wx, wy))));
}

function next_time(arrival, time) {
let _, after, ahead, before, begin, crossings;
begin = max(time, mul(kernel.interception(arrival.ends.x, arrival.ends.y, arrival.wx, arrival.wy), sub(1.0, ROUNDING)));
for (_ of iter(range(MOST_WINDOWS))) {
crossings = [begin, ...iter(crossing_times(arrival, begin, add(begin, WINDOW))), add(begin, WINDOW)];
for ([before, after] of rows(pairwise(crossings))) {
if (truth(is_in_time(arrival, mul(0.5, add(before, after))))) {
return before;
}
}
[begin, ahead] = iter([add(begin, WINDOW), WINDOW]);
while ((lt(ahead, math.inf) && truth(has_no_crossing(arrival, begin, add(begin, ahead))))) {
[begin, ahead] = iter([add(begin, ahead), mul(2.0, ahead)]);
}
}
return math.inf;
}

function* _zone_curves(zone, clearance_m) {
let radius_m;
if (truth(isinstance(zone, PolygonZone))) {
yield* iter(_polygon_curves(zone, clearance_m));
return;
}
radius_m = (truth(zone.inclusion) ? sub(zone.radius_m, clearance_m) : add(zone.radius_m, clearance_m));
if (gt(radius_m, 0.0)) {
yield Curve(zone.east_m, zone.north_m, radius_m, 0.0, math.tau, 0.0, 0.0, [1, -1]);
}
}

const Curve = struct(class extends Tuple {
constructor(x, y, radius, a, width, dx, dy, ways, joined = false, anywhere = false) {
super();
this.x = x;
this.y = y;
this.radius = radius;
this.a = a;
this.width = width;
this.dx = dx;
this.dy = dy;
this.ways = ways;
this.joined = joined;
this.anywhere = anywhere;

}
get closed() {
const self = this;
return eq(self.width, math.tau);
}
steps(turn_radius_m, refined) {
let length, on_line;
const self = this;
if (truth(self.joined)) {
return (truth(self.anywhere) ? 1 : mul(JOINS, refined));
}
length = math.hypot(self.dx, self.dy);
on_line = min(math.ceil(div(length, mul(LINE_STEP, turn_radius_m))), MOST_ON_LINE);
return max(1, mul(refined, max(on_line, math.ceil(div(self.width, ARC_STEP_RAD)))));
}
}, ["x", "y", "radius", "a", "width", "dx", "dy", "ways", "joined", "anywhere"], 'Curve');

const StillAir = struct(class extends Values {
constructor(fence, problem, margin_m, curves) {
super();
const self = this;
[self._fence, self._problem, self._margin_m, self._curves] = iter([fence, problem, margin_m, curves]);
self._radius_m = problem.aircraft.turn_radius_m;
}
headings(contacts) {
const self = this;
return contacts.angle;
}
least_lengths(contacts, headings) {
let c, dx, dy, least, orbit, r, radius, s;
const self = this;
[orbit, r] = iter([self._problem.orbit, self._radius_m]);
[dx, dy, c, s] = iter([div(sub(contacts.x, orbit.east_m), r), div(sub(contacts.y, orbit.north_m), r), np.cos(headings), np.sin(headings)]);
radius = max(self._problem.radius, 1.0);
least = arrays.min_time(...iter(arrays.reduce_states(dx, dy, c, s)), radius, orbit.turn);
return np.where(contacts.joined, 0.0, mul(mul(least, r), sub(1.0, ROUNDING)));
}
words(start, at, contacts, headings) {
let found, placed, several;
const self = this;
placed = item(invert(contacts.anywhere).nonzero(), 0);
found = words_between(...iter(start), item(contacts.x, placed), item(contacts.y, placed), item(headings, placed), self._radius_m);
several = [replace(found, { to: item(placed, found.to) }), _onto_circle(self._entries(start), contacts, self._radius_m)];
if (((at != null) && gt(item(self._curves, item(contacts.curve, at)).radius, self._radius_m))) {
append_(several, self._along(at, contacts));
}
return Words.joined(several);
}
_entries(start) {
let orbit, place, r, state;
const self = this;
[orbit, r] = iter([self._problem.orbit, self._radius_m]);
place = [div(sub(start.x, orbit.east_m), r), div(sub(start.y, orbit.north_m), r)];
state = arrays.reduce_states(...iter(place), math.cos(start.heading), math.sin(start.heading));
return kernel.synthesis_ranked(...iter(state), kernel.rounded_radius(self._problem.radius), item(SIDES, orbit.turn), 0.0);
}
_along(at, contacts) {
let curve, length, others, turned, way, zero;
const self = this;
[curve, way] = iter([item(self._curves, item(contacts.curve, at)), item(contacts.way, at)]);
others = item(bit_and(eq(contacts.curve, item(contacts.curve, at)), eq(contacts.way, way)).nonzero(), 0);
turned = mul(mul(sub(item(contacts.share, others), item(contacts.share, at)), way), curve.width);
turned = (truth(curve.closed) ? np.mod(turned, math.tau) : turned);
[others, turned] = iter([item(others, gt(turned, 0.0)), item(turned, gt(turned, 0.0))]);
zero = np.zeros_like(turned);
length = np.stack([mul(turned, curve.radius), zero, zero], { axis: -1 });
return Words(others, np.full(length.shape, float(way)), length, np.full(length.shape, curve.radius));
}
fastest_entries(poses) {
let dx, dy, orbit, r, x, y;
const self = this;
[orbit, r] = iter([self._problem.orbit, self._radius_m]);
[dx, dy] = iter([div(sub(poses.x, orbit.east_m), r), div(sub(poses.y, orbit.north_m), r)]);
[x, y] = iter(arrays.reduce_states(dx, dy, np.cos(poses.heading), np.sin(poses.heading)));
return _words_of(arrays.optima(x, y, max(self._problem.radius, 1.0), item(SIDES, orbit.turn)), r);
}
flown(start, control, length) {
let x, y;
const self = this;
[x, y] = iter(airs__flown(start.x, start.y, start.heading, control, length, self._radius_m, 0.0, 0.0));
return Pose2(x, y, add(start.heading, div(mul(control, length), self._radius_m)));
}
are_clear(start, words) {
let angle, arcs, bent, c, clear, ends, heading, k, length, next_x, next_y, nx, ny, radius, s, straight, u, x, y;
const self = this;
clear = np.ones(words.to.size, bool);
[x, y, heading] = iter(list(iter(start)).map((value) => add(np.zeros(words.to.size), value)));
for (k of iter(range(3))) {
[u, length, radius] = iter([item(words.control, [slice(null, null), k]), item(words.length, [slice(null, null), k]), item(words.radius, [slice(null, null), k])]);
[c, s, angle] = iter([np.cos(heading), np.sin(heading), div(length, radius)]);
[next_x, next_y] = iter(airs__flown(x, y, heading, u, length, radius, 0.0, 0.0));
bent = item(bit_and(bit_and(clear, ne(u, 0.0)), gt(length, 0.0)).nonzero(), 0);
if (truth(bent.size)) {
[nx, ny] = iter([mul(u, s), mul(neg(u), c)]);
arcs = [sub(x, mul(radius, nx)), sub(y, mul(radius, ny)), radius, nx, ny, u, angle];
set_item(clear, bent, _clear_arcs(self._fence, Arcs(...iter(list(iter(arcs)).map((v) => item(v, [bent, null])))), self._margin_m));
}
straight = item(bit_and(bit_and(clear, eq(u, 0.0)), gt(length, 0.0)).nonzero(), 0);
if (truth(straight.size)) {
ends = list(iter([x, y, next_x, next_y])).map((v) => item(v, straight));
set_item(clear, straight, _clear_chords(self._fence, ends, self._margin_m));
}
[x, y, heading] = iter([next_x, next_y, add(heading, mul(u, angle))]);
}
return clear;
}
}, []);

const SteadyWind = struct(class extends Values {
constructor(fence, problem, margin_m) {
super();
let largest_m;
const self = this;
[self._fence, self._problem, self._margin_m] = iter([fence, problem, margin_m]);
self._radius_m = problem.aircraft.turn_radius_m;
self._step_m = pow(mul(mul(8.0, CHORD_ERROR_M), self._radius_m), 0.5);
[self._wx, self._wy] = iter(problem.relative_wind);
largest_m = mul(mul(8.0, CHORD_ERROR_M), pow(div(MOST_IN_TURN, math.tau), 2));
if (gt(self._radius_m, largest_m)) {
throw errors.OutOfRange(`the turn radius of ${format(self._radius_m, `.4g`)} m is too large for a search for clear entries in wind: it must be at most ${format(largest_m, `.4g`)} m`);
}
}
headings(contacts) {
let across;
const self = this;
across = sub(mul(self._wy, np.cos(contacts.angle)), mul(self._wx, np.sin(contacts.angle)));
return sub(contacts.angle, np.arcsin(across));
}
least_lengths(contacts, headings) {
let dx, dy, free, least, orbit, r;
const self = this;
[orbit, r] = iter([self._problem.orbit, self._radius_m]);
[dx, dy] = iter([div(sub(contacts.x, orbit.east_m), r), div(sub(contacts.y, orbit.north_m), r)]);
least = np.zeros(contacts.x.size);
free = invert(contacts.joined);
set_item(least, free, arrays.min_time_in_wind(item(dx, free), item(dy, free), item(headings, free), self._problem.radius, orbit.turn, self._wx, self._wy));
return mul(mul(np.where(np.isfinite(least), least, 0.0), r), sub(1.0, 1e-09));
}
words(start, at, contacts, headings) {
let control, exists, found, heading, length, pieces, placed, r, to, word, x, y;
const self = this;
[r, placed] = iter([self._radius_m, item(invert(contacts.anywhere).nonzero(), 0)]);
[to, word] = iter([np.repeat(placed, len(SIX)), np.tile(SIX, placed.size)]);
[x, y, heading] = iter([div(sub(start.x, item(contacts.x, to)), r), div(sub(start.y, item(contacts.y, to)), r), start.heading]);
pieces = arrays.path_to_pose(word, x, y, math.cos(heading), math.sin(heading), item(contacts.angle, to), self._wx, self._wy);
exists = item(lt(item(pieces, 0), math.inf).nonzero(), 0);
length = mul(item(np.stack(pieces, { axis: -1 }), exists), r);
control = item(np.array(SIX_CONTROLS), item(np.tile(np.arange(len(SIX)), placed.size), exists));
found = Words(item(to, exists), control, length, np.full(length.shape, r));
return Words.joined([found, _onto_circle(self._entries(start), contacts, r)]);
}
_entries(start) {
let heading, orbit, place, problem, r;
const self = this;
[orbit, r] = iter([self._problem.orbit, self._radius_m]);
place = [div(sub(start.x, orbit.east_m), r), div(sub(start.y, orbit.north_m), r)];
heading = [math.cos(start.heading), math.sin(start.heading)];
problem = WindProblem(...iter(place), ...iter(heading), self._problem.radius, item(SIDES, orbit.turn), self._wx, self._wy, 0.0);
return list(iter(kernel.wind_search_ranked(problem))).filter((found) => eq(found.status, kernel.Status.OK)).map((found) => kernel.entry_of(found));
}
fastest_entries(poses) {
let c, orbit, r, s, x, y;
const self = this;
[orbit, r] = iter([self._problem.orbit, self._radius_m]);
[x, y] = iter([div(sub(poses.x, orbit.east_m), r), div(sub(poses.y, orbit.north_m), r)]);
[c, s] = iter([np.cos(poses.heading), np.sin(poses.heading)]);
return _words_of(arrays.optima_in_wind(x, y, c, s, self._problem.radius, item(SIDES, orbit.turn), self._wx, self._wy), r);
}
flown(start, control, length) {
let x, y;
const self = this;
[x, y] = iter(airs__flown(start.x, start.y, start.heading, control, length, self._radius_m, self._wx, self._wy));
return Pose2(x, y, add(start.heading, div(mul(control, length), self._radius_m)));
}
are_clear(start, words) {
let chords, clear, counts, ends, flown, good, heading, i, j, k, length, n, r, tried, u, width, wind_x, wind_y, x, y;
const self = this;
[n, r] = iter([words.to.size, self._radius_m]);
clear = np.ones(n, bool);
[wind_x, wind_y] = iter([self._wx, self._wy]);
[x, y, heading] = iter(list(iter(start)).map((value) => add(np.zeros(n), value)));
for (k of iter(range(3))) {
[u, length] = iter([item(words.control, [slice(null, null), k]), item(words.length, [slice(null, null), k])]);
chords = np.where(eq(u, 0.0), 1, np.ceil(div(length, self._step_m)));
for (tried of iter(_portions(item(bit_and(clear, gt(length, 0.0)).nonzero(), 0), chords))) {
counts = item(chords, tried).astype(np.intp);
i = np.repeat(tried, counts);
j = sub(np.arange(i.size), np.repeat(sub(np.cumsum(counts), counts), counts));
width = div(item(length, i), np.repeat(counts, counts));
ends = [];
for (flown of iter([mul(j, width), mul(add(j, 1), width)])) {
ends = add(ends, airs__flown(item(x, i), item(y, i), item(heading, i), item(u, i), flown, r, wind_x, wind_y));
}
good = _clear_chords(self._fence, ends, add(self._margin_m, CHORD_ERROR_M));
np.logical_and.at(clear, i, good);
}
[x, y] = iter(airs__flown(x, y, heading, u, length, r, wind_x, wind_y));
heading = add(heading, div(mul(u, length), r));
}
return clear;
}
}, []);

const Contacts = struct(class extends Tuple {
constructor(curve, share, way, x, y, angle, joined, anywhere) {
super();
this.curve = curve;
this.share = share;
this.way = way;
this.x = x;
this.y = y;
this.angle = angle;
this.joined = joined;
this.anywhere = anywhere;

}
take(i) {
const self = this;
return Contacts(...iter(list(iter(self)).map((column) => item(column, i))));
}
}, ["curve", "share", "way", "x", "y", "angle", "joined", "anywhere"], 'Contacts');

function _taken(poses, i) {
return _poses(item(poses.x, i), item(poses.y, i), item(poses.heading, i));
}

const Words = struct(class extends Tuple {
constructor(to, control, length, radius) {
super();
this.to = to;
this.control = control;
this.length = length;
this.radius = radius;

}
take(i) {
const self = this;
return Words(...iter(list(iter(self)).map((column) => item(column, i))));
}
static of(cls, words, radius) {
let control, length, to;
to = np.array(list(iter(words)).map((word) => word.to), np.intp);
[control, length] = iter(list(iter([list(iter(words)).map((word) => word.control), list(iter(words)).map((word) => word.length)])).map((rows_) => np.array(rows_, float).reshape(-1, 3)));
return cls(to, control, mul(length, radius), np.full(length.shape, radius));
}
static joined(cls, several) {
return cls(...iter(list(iter(zip(...iter(several)))).map((columns) => np.concatenate(columns))));
}
}, ["to", "control", "length", "radius"], 'Words');

const _Lattice = struct(class extends Values {
constructor(search, start, radius_m, step) {
super();
const self = this;
[self._search, self._r, self._step] = iter([search, radius_m, step]);
[self._poses, self._length, self._parent, self._control] = iter([[start], [0.0], [0], [0.0]]);
self._bound = [0.0];
self._seen = new Map(list(iter(tolist_(self._cells(self._columns([0]))))).map((cell) => [cell, true]));
}
path(most_m) {
let batch, best, first, heap, k, length, node, nodes, words;
const self = this;
[heap, best] = iter([[[0.0, 0]], null]);
while ((truth(heap) && lt(item(item(heap, 0), 0), most_m) && lt(len(self._poses), lattice_MOST_POSES))) {
batch = list(iter(range(min(lattice_BATCH, len(heap))))).map((_) => item(heappop(heap), 1));
nodes = list(iter(batch)).filter((node) => truth(self._has_new_entry(node))).map((node) => node);
if (truth(nodes)) {
[words, length] = iter(self._search.endings(self._columns(nodes), np.array(list(iter(nodes)).map((k) => item(self._length, k)))));
k = int(length.argmin());
if (lt(item(length, k), most_m)) {
most_m = float(item(length, k));
best = path_with(self._pieces_to(item(nodes, k)), words, k, most_m);
}
}
first = len(self._poses);
self._expand(batch, most_m);
for (node of iter(range(first, len(self._poses)))) {
heappush(heap, [item(self._bound, node), node]);
}
}
return best;
}
_has_new_entry(node) {
const self = this;
return ge(sub(item(self._bound, node), item(self._bound, item(self._parent, node))), mul(SAME_ENTRY, self._r));
}
_expand(batch, most_m) {
let bound, cells, clear, control, flown, i, j, k, length, nodes, reached;
const self = this;
nodes = list(iter(batch)).flatMap((node) => list(iter(range(3))).map((_) => node));
control = np.tile([1.0, 0.0, -1.0], len(batch));
length = np.full(control.size, mul(self._step, self._r));
[clear, reached] = iter(self._search.one_piece(self._columns(nodes), control, length));
i = item(clear.nonzero(), 0);
reached = _taken(reached, i);
flown = add(item(np.array(list(iter(nodes)).map((node) => item(self._length, node))), i), item(length, i));
[bound, cells] = iter([add(flown, self._search.least(reached)), tolist_(self._cells(reached))]);
for ([k, j] of rows(enumerate(tolist_(i)))) {
if ((lt(item(bound, k), most_m) && !has(item(cells, k), self._seen))) {
set_item(self._seen, item(cells, k), true);
append_(self._poses, Pose2(float(item(reached.x, k)), float(item(reached.y, k)), float(item(reached.heading, k))));
append_(self._length, float(item(flown, k)));
append_(self._parent, item(nodes, j));
append_(self._control, float(item(control, j)));
append_(self._bound, float(item(bound, k)));
}
}
}
_columns(nodes) {
const self = this;
return _poses(...iter(np.array(list(iter(nodes)).map((node) => item(self._poses, node))).T));
}
_cells(poses) {
let heading, start, width, x, y;
const self = this;
[width, start] = iter([mul(CELL, self._step), item(self._poses, 0)]);
x = np.floor(add(div(sub(poses.x, start.x), mul(width, self._r)), 0.5));
y = np.floor(add(div(sub(poses.y, start.y), mul(width, self._r)), 0.5));
heading = np.floor(add(div(np.mod(poses.heading, mul(2.0, math.pi)), width), 0.5));
return add(mul(add(mul(heading, SPAN), x), SPAN), y);
}
_pieces_to(node) {
let pieces;
const self = this;
pieces = [];
while (ne(node, 0)) {
append_(pieces, Piece(item(self._control, node), mul(self._step, self._r), self._r));
node = item(self._parent, node);
}
return sliced(pieces, null, null, -1);
}
}, []);

function _moves(free, sweep) {
let both, dense, each, number, places;
places = np.arange(free);
each = list(iter(range(free))).flatMap((k) => list(iter([1.0, -1.0])).map((sign) => mul(sign, eq(places, k))));
both = list(iter(enumerate(each))).map((one) => iter(one)).flatMap(([i, a]) => list(iter(sliced(each, sub(add(i, 2), mod(i, 2)), add(i, NEIGHBOURS), null))).map((b) => add(a, b)));
number = add(mul(DENSE, sweep), np.arange(DENSE));
dense = np.stack(list(iter(range(free))).map((k) => np.sin(mul(number, pow(add(k, 2.0), 0.5)))), { axis: -1 });
return np.concatenate([np.stack([...iter(each), ...iter(both)]), dense]);
}

function _poses(x, y, heading) {
return Pose2(x, y, heading);
}

const Piece = struct(class extends Tuple {
constructor(control, length_m, radius_m) {
super();
this.control = control;
this.length_m = length_m;
this.radius_m = radius_m;

}
}, ["control", "length_m", "radius_m"], 'Piece');

function path_with(first, words, k, length_m) {
let columns, merged, piece;
columns = [item(words.control, k), item(words.length, k), item(words.radius, k)];
merged = [];
for (piece of iter([...iter(first), ...iter(list(iter(zip(...iter(columns)))).map((piece) => Piece(...iter(map(float, piece)))))])) {
if (lt(piece.length_m, NO_PIECE_M)) {
continue;
}
if ((truth(merged) && eq(item(merged, -1).control, piece.control))) {
set_item(merged, -1, replace(piece, { length_m: add(piece.length_m, item(merged, -1).length_m) }));
} else {
append_(merged, piece);
}
}
return ClearPath(tuple(merged), length_m, neg(int(item(words.to, k))));
}

function* _turns_at(curves, u, cx, cy, distance, radius_m) {
let curve, i, normal, offset, share, tx, ty, way;
for ([i, curve] of rows(enumerate(curves))) {
for (way of iter((truth(curve.joined) ? [] : curve.ways))) {
offset = sub(curve.radius, mul(mul(u, way), radius_m));
if ((lt(mul(u, way), 0) || (gt(curve.width, 0.0) && lt(curve.radius, radius_m)))) {
for (share of iter(_shares_at(curve, offset, cx, cy, distance))) {
normal = add(curve.a, mul(share, curve.width));
[tx, ty] = iter([add(curve.x, mul(share, curve.dx)), add(curve.y, mul(share, curve.dy))]);
yield [[i, share, way], add(tx, mul(offset, math.cos(normal))), add(ty, mul(offset, math.sin(normal)))];
}
}
}
}
}

function _tangents(cx, cy, radius, u, curve, way) {
let apart, cosine, dx, dy, found, normal, share, side;
[dx, dy] = iter([sub(curve.x, cx), sub(curve.y, cy)]);
apart = math.hypot(dx, dy);
cosine = (gt(apart, 0.0) ? div(sub(mul(mul(u, way), radius), curve.radius), apart) : math.inf);
if (gt(abs(cosine), 1.0)) {
return [];
}
found = [];
for (side of iter([1.0, -1.0])) {
normal = add(math.atan2(dy, dx), mul(side, math.acos(cosine)));
share = div(mod(sub(normal, curve.a), math.tau), curve.width);
if ((le(share, 1.0) && ge(mul(way, sub(mul(dy, math.cos(normal)), mul(dx, math.sin(normal)))), 0.0))) {
append_(found, [(eq(u, way) ? normal : add(normal, math.pi)), share]);
}
}
return found;
}

function _touched(chain) {
let touched;
touched = zip(tolist_(chain.contacts.curve), tolist_(chain.contacts.way));
return join_(" ", dict.fromkeys(list(iter(touched)).map((one) => iter(one)).map(([curve, way]) => `${format(curve, `d`)},${format(way, `d`)}`)));
}

function _cost(words) {
let cost;
cost = add(words.length.sum({ axis: 1 }), mul(PIECE_M, gt(words.length, NO_PIECE_M).sum({ axis: 1 })));
return cost;
}

const _Expansion = struct(class extends Values {
constructor(node, bound, words, clear, next = 0) {
super();
this.node = node;
this.bound = bound;
this.words = words;
this.clear = clear;
this.next = next;

}
}, ["node", "bound", "words", "clear", "next"], '_Expansion');

const Chain = struct(class extends Tuple {
constructor(length_m, paths, contacts) {
super();
this.length_m = length_m;
this.paths = paths;
this.contacts = contacts;

}
}, ["length_m", "paths", "contacts"], 'Chain');

function clearance(problem) {
let R, _, distances, ordinate, rm, rp, squares, x, y;
[x, y, R, _, _] = iter(problem);
distances = [abs(y)];
for (ordinate of iter([y, neg(y)])) {
[rp, rm] = iter([math.hypot(x, add(ordinate, 1.0)), math.hypot(x, sub(ordinate, 1.0))]);
squares = [[kernel.beyond(x, ordinate, R, 2.0), add(add(rp, R), 1.0)], [kernel.beyond(x, ordinate, neg(R), 2.0), add(rp, abs(sub(R, 1.0)))], [kernel.beyond(x, ordinate, sub(2.0, R), 2.0), add(rp, abs(sub(R, 3.0)))], [kernel.beyond(x, ordinate, R, -2.0), add(rm, abs(sub(R, 1.0)))], [kernel.beyond(x, ordinate, neg(R), -2.0), add(add(rm, R), 1.0)]];
distances = add(distances, list(iter(squares)).map((one) => iter(one)).filter(([square, total]) => gt(total, 0.0)).map(([square, total]) => div(abs(square), total)));
}
return min(list(iter(distances)).filter((distance) => gt(distance, kernel.rounding(x, y, R))).map((distance) => distance), { default: math.inf });
}

function _beside_same(same, u, turned, t) {
let a, arcs, best, k, ok, straight;
best = add(np.abs(same), np.inf);
for (k of iter(range(3))) {
arcs = add(turned, mul(math.tau, k));
straight = sub(t, arcs);
for (a of iter([mul(0.0, t), arcs, mod(mul(u, np.angle(same)), math.tau)])) {
ok = bit_and(ge(straight, 0.0), le(a, arcs));
best = np.where(ok, np.minimum(best, np.abs(sub(same, mul(straight, np.exp(mul(mul(new Complex(0.0, 1.0), u), a)))))), best);
}
}
return best;
}

function _beside_other(other, u, turned, t) {
let a, best, direction, end, found, k, least, more, most, ok, tip;
best = add(np.abs(other), np.inf);
tip = np.arcsin(div(mul(-2.0, u), np.abs(other)));
for (k of iter(range(-2, 2))) {
more = add(turned, mul(math.tau, k));
[least, most] = iter([np.maximum(more, 0.0), mul(0.5, add(t, more))]);
found = [least, most];
for (direction of iter([sub(np.angle(other), tip), add(sub(np.angle(other), math.pi), tip)])) {
found = add(found, list(iter(range(3))).map((n) => add(mod(mul(u, direction), math.tau), mul(math.tau, n))));
}
for (a of iter(found)) {
end = mul(sub(add(sub(t, mul(2.0, a)), more), mul(new Complex(0.0, 2.0), u)), np.exp(mul(mul(new Complex(0.0, 1.0), u), a)));
ok = bit_and(ge(a, least), le(a, most));
best = np.where(ok, np.fmin(best, np.abs(sub(other, end))), best);
}
}
return best;
}

function _beside_three_arcs(same, u, turned, t) {
let a, best, chord, k, middle, most, ok;
best = add(np.abs(same), np.inf);
for (k of iter(range(2))) {
middle = add(mul(0.5, mod(sub(t, turned), math.tau)), mul(math.pi, k));
most = sub(t, middle);
chord = mul(mul(new Complex(0.0, 2.0), u), sub(np.exp(mul(mul(neg(new Complex(0.0, 1.0)), u), middle)), 1.0));
for (a of iter([mul(0.0, t), most, mod(mul(u, sub(np.angle(same), np.angle(chord))), math.tau)])) {
ok = bit_and(ge(most, 0.0), le(a, most));
best = np.where(ok, np.minimum(best, np.abs(sub(same, mul(chord, np.exp(mul(mul(new Complex(0.0, 1.0), u), a)))))), best);
}
}
return best;
}

function _path(one) {
return path_of_length(one.arrival.at(one.time), one.time, one.length_tolerance);
}

function _maneuver(problem, path, turn, time_s, bearing_deg) {
let east, end, miss_m, north, orbit, segments;
segments = tuple(_segments(problem, path));
[orbit, [east, north]] = iter([problem.orbit.after(time_s), heading_vector(bearing_deg)]);
end = (truth(segments) ? item(segments, -1).end : problem.pose);
miss_m = math.hypot(sub(sub(end.east_m, orbit.east_m), mul(orbit.radius_m, east)), sub(sub(end.north_m, orbit.north_m), mul(orbit.radius_m, north)));
return Maneuver(problem.pose, problem.orbit, problem.aircraft, turn, segments, miss_m, problem.wind);
}

const Arrival = struct(class extends Tuple {
constructor(ends, wx, wy) {
super();
this.ends = ends;
this.wx = wx;
this.wy = wy;

}
at(time) {
const self = this;
return replace(self.ends, { x: sub(self.ends.x, mul(self.wx, time)), y: sub(self.ends.y, mul(self.wy, time)) });
}
}, ["ends", "wx", "wy"], 'Arrival');

const Ends = struct(class extends Tuple {
constructor(c0, s0, x, y, c, s) {
super();
this.c0 = c0;
this.s0 = s0;
this.x = x;
this.y = y;
this.c = c;
this.s = s;

}
}, ["c0", "s0", "x", "y", "c", "s"], 'Ends');

const PlacedArrival = struct(class extends Tuple {
constructor(turn, arrival, time, length_tolerance) {
super();
this.turn = turn;
this.arrival = arrival;
this.time = time;
this.length_tolerance = length_tolerance;

}
}, ["turn", "arrival", "time", "length_tolerance"], 'PlacedArrival');

function crossing_times(arrival, begin, end) {
let first, found, halves, last;
found = [];
for ([first, last] of rows(OUTER_CONTROLS)) {
found = add(found, straight_crossings(arrival, first, last, begin, end));
}
for (first of iter([1, -1])) {
for (halves of iter([0, 1])) {
found = add(found, arc_crossings(arrival, first, halves, begin, end));
}
}
return sorted(found);
}

function is_in_time(arrival, time) {
return is_reachable(arrival.at(time), time);
}

function has_no_crossing(arrival, begin, end) {
let dx, dy, ends, enter, fall, first, is_there, last, leave, wx, wy;
[ends, wx, wy] = iter(arrival);
for ([first, last] of rows(OUTER_CONTROLS)) {
[dx, dy] = iter([add(sub(ends.x, mul(last, ends.s)), mul(first, ends.s0)), sub(add(ends.y, mul(last, ends.c)), mul(first, ends.c0))]);
[enter, leave] = iter(kernel.time_within(dx, dy, wx, wy, (eq(first, last) ? 4.0 : 2.0)));
if ((le(enter, end) && le(begin, leave) && (eq(first, last) || !(lt(enter, begin) && le(begin, end) && lt(end, leave))))) {
return false;
}
is_there = (eq(first, last) || lt(end, enter) || lt(leave, begin));
fall = (truth(is_there) ? mul(falls_at(arrival, first, last, begin), sub(end, begin)) : 0.0);
if ((truth(is_there) && ge(fall, mod(excess_of(arrival, first, last, begin), TWO_PI)))) {
return false;
}
}
return true;
}

function* _polygon_curves(zone, clearance_m) {
let corners, ex, ey, fx, fy, normal, sides, turned, x, y;
corners = _forbidden_left(zone);
sides = list(iter(zip(corners, [...iter(sliced(corners, 1, null, null)), item(corners, 0)]))).map((one) => iter(one)).map(([a, b]) => [sub(item(b, 0), item(a, 0)), sub(item(b, 1), item(a, 1))]);
for ([[x, y], [ex, ey], [fx, fy]] of rows(zip(corners, [item(sides, -1), ...iter(sliced(sides, null, -1, null))], sides))) {
normal = math.atan2(neg(fx), fy);
yield Curve(x, y, clearance_m, normal, 0.0, fx, fy, [1, -1]);
turned = math.atan2(sub(mul(ex, fy), mul(ey, fx)), add(mul(ex, fx), mul(ey, fy)));
if (gt(turned, 0.0)) {
yield Curve(x, y, clearance_m, sub(normal, turned), turned, 0.0, 0.0, [1, -1]);
}
}
}

function words_between(x, y, angle, to_x, to_y, to_angle, radius) {
let across, along, c, control, controls, dx, dy, exists, found, lengths, pieces, s, turned, u;
[c, s] = iter([np.cos(angle), np.sin(angle)]);
[dx, dy] = iter([div(sub(to_x, x), radius), div(sub(to_y, y), radius)]);
[along, across, turned] = iter([add(mul(dx, c), mul(dy, s)), sub(mul(dy, c), mul(dx, s)), sub(to_angle, angle)]);
found = [];
for (u of iter([1.0, -1.0])) {
for ([controls, pieces] of rows(_left_words(along, mul(u, across), mul(u, turned)))) {
lengths = np.stack(pieces, { axis: -1 });
exists = np.flatnonzero(np.isfinite(lengths).all({ axis: 1 }));
control = np.tile(mul(np.array(controls), u), [exists.size, 1]);
append_(found, Words(exists, control, mul(item(lengths, exists), radius), np.full(control.shape, radius)));
}
}
return Words.joined(found);
}

function _onto_circle(entries, contacts, radius_m) {
let control, ends, entry, rows_;
ends = new Map(list(iter(tolist_(item(contacts.anywhere.nonzero(), 0)))).map((i) => [int(item(contacts.way, i)), i]));
rows_ = [];
for (entry of iter(entries)) {
if (has(neg(entry.side), ends)) {
control = tuple(list(iter(kernel.controls(entry.word))).map((u) => (ne(u, ABSENT) ? float(u) : 0.0)));
append_(rows_, Word(item(ends, neg(entry.side)), control, [entry.t1, entry.t2, entry.t3]));
}
}
return Words.of(rows_, radius_m);
}

function _words_of(optima, radius_m) {
let control, known, length, side, t1, t2, t3, word;
[word, t1, t2, t3, side] = iter(optima);
known = new Map(list(iter(set(tolist_(word)))).map((code) => [code, list(iter(kernel.controls(code))).map((u) => (ne(u, ABSENT) ? float(u) : 0.0))]));
control = np.array(list(iter(tolist_(word))).map((code) => item(known, code)));
length = mul(np.stack([t1, t2, t3], { axis: -1 }), radius_m);
return Words(side, control, length, np.full(length.shape, radius_m));
}

function airs__flown(x, y, heading, u, length, r, wx, wy) {
let angle, chord, half;
angle = div(length, r);
[half, chord] = iter([add(heading, mul(mul(0.5, u), angle)), np.where(eq(u, 0.0), length, mul(mul(2.0, r), np.sin(mul(0.5, angle))))]);
return [add(add(x, mul(chord, np.cos(half))), mul(wx, length)), add(add(y, mul(chord, np.sin(half))), mul(wy, length))];
}

function _clear_arcs(fence, arcs, margin_m) {
let circles, clear, found, least, outside;
[clear, least] = iter([np.ones(item(arcs.x.shape, 0), bool), add(margin_m, TOUCH_M)]);
if (truth(fence.polygons)) {
clear = bit_and(clear, gt(arc_to_edge(arcs, fence.edges).distance.min({ axis: 1 }), least));
}
if (truth(fence.circle_zones)) {
circles = fence.circles;
found = arc_to_point(arcs, circles.x, circles.y);
outside = np.where(gt(circles.sign, 0.0), found.least.distance, found.largest.distance);
clear = bit_and(clear, gt(mul(circles.sign, sub(outside, circles.radius)).min({ axis: 1 }), least));
}
return clear;
}

function _clear_chords(fence, ends, margin_m) {
let ax, ay, bx, by, circles, clear, far, least, near, outside;
[ax, ay, bx, by] = iter(list(iter(ends)).map((v) => item(v, [slice(null, null), null])));
[clear, least] = iter([np.ones(item(ax.shape, 0), bool), add(margin_m, TOUCH_M)]);
if (truth(fence.polygons)) {
clear = bit_and(clear, gt(chord_to_edge(ax, ay, bx, by, fence.edges).nearest.distance.min({ axis: 1 }), least));
}
if (truth(fence.circle_zones)) {
circles = fence.circles;
near = chord_to_point(ax, ay, bx, by, circles.x, circles.y).distance;
far = np.maximum(np.hypot(sub(ax, circles.x), sub(ay, circles.y)), np.hypot(sub(bx, circles.x), sub(by, circles.y)));
outside = np.where(gt(circles.sign, 0.0), near, far);
clear = bit_and(clear, gt(mul(circles.sign, sub(outside, circles.radius)).min({ axis: 1 }), least));
}
return clear;
}

function _portions(tried, chords) {
let portion;
portion = np.floor(div(np.cumsum(item(chords, tried)), MOST_AT_ONCE));
return list(iter(sorted(set(tolist_(portion))))).map((k) => item(tried, eq(portion, k)));
}

const ClearPath = struct(class extends Tuple {
constructor(pieces, length_m, way) {
super();
this.pieces = pieces;
this.length_m = length_m;
this.way = way;

}
}, ["pieces", "length_m", "way"], 'ClearPath');

function _shares_at(curve, offset, cx, cy, distance) {
let a, apart, b, cosine, normals, root_2, shares, wx, wy;
if (gt(curve.width, 0.0)) {
[wx, wy] = iter([sub(curve.x, cx), sub(curve.y, cy)]);
apart = math.hypot(wx, wy);
cosine = (ne(mul(offset, apart), 0.0) ? div(sub(sub(pow(distance, 2), pow(apart, 2)), pow(offset, 2)), mul(mul(2.0, offset), apart)) : math.inf);
if (gt(abs(cosine), 1.0)) {
return [];
}
normals = list(iter([1.0, -1.0])).map((side) => add(math.atan2(wy, wx), mul(side, math.acos(cosine))));
shares = list(iter(normals)).map((normal) => div(mod(sub(normal, curve.a), math.tau), curve.width));
} else {
[wx, wy] = iter([sub(add(curve.x, mul(offset, math.cos(curve.a))), cx), sub(add(curve.y, mul(offset, math.sin(curve.a))), cy)]);
[a, b] = iter([add(pow(curve.dx, 2), pow(curve.dy, 2)), add(mul(wx, curve.dx), mul(wy, curve.dy))]);
root_2 = sub(mul(b, b), mul(a, sub(add(mul(wx, wx), mul(wy, wy)), pow(distance, 2))));
shares = (ge(root_2, 0.0) ? list(iter([1.0, -1.0])).map((side) => div(add(neg(b), mul(side, math.sqrt(root_2))), a)) : []);
}
return list(iter(shares)).filter((share) => (le(0.0, share) && le(share, 1.0))).map((share) => share);
}

function path_of_length(ends, wanted, length_tolerance) {
let at_edge, exact, found, path, rest, stretch, turns;
found = [];
for (stretch of iter(stretches(ends))) {
turns = turns_more(stretch, wanted, length_tolerance);
if (ge(turns, 0)) {
rest = sub(wanted, mul(TWO_PI, turns));
path = path_within(stretch, rest, length_tolerance);
if (le(abs(sub(path.length, rest)), mul(SAME_LENGTH, add(1.0, wanted)))) {
path = with_length(path, ends, rest);
append_(found, replace(path, { t1: add(path.t1, mul(TWO_PI, turns)) }));
}
}
}
exact = list(iter(found)).filter((path) => truth(is_exact(path, ends, wanted, length_tolerance))).map((path) => path);
if (!truth(exact)) {
at_edge = paths_at_edge(ends, wanted);
exact = list(iter(at_edge)).filter((path) => truth(is_exact(path, ends, wanted, length_tolerance))).map((path) => path);
}
return min(or(exact, () => found), { key: ((path) => path.turning), default: null });
}

function* _segments(problem, path) {
let flown, here, k, letter, now, pieces, r, radius_m, straight, t;
[here, now, r] = iter([problem.pose, 0.0, problem.aircraft.turn_radius_m]);
pieces = [[float(path.first), path.t1], [path.curvature, path.t2], [float(path.last), path.t3]];
for ([k, t] of rows(pieces)) {
if (gt(t, ROUNDING)) {
straight = lt(mul(mul(abs(k), t), max(t, 1.0)), ROUNDING);
letter = (truth(straight) ? "S" : (gt(k, 0.0) ? "L" : "R"));
radius_m = ((truth(straight) || eq(abs(k), 1.0)) ? r : div(r, abs(k)));
flown = segment(here, now, letter, mul(t, r), problem.aircraft, problem.wind, radius_m);
yield flown;
[here, now] = iter([flown.end, add(now, flown.duration_s)]);
}
}
}

function straight_crossings(arrival, first, last, begin, end) {
let a, b, dx, dy, ends, excess, found, i, steps, times, values, within, wx, wy;
[ends, wx, wy] = iter(arrival);
excess = function (time) {
return excess_of(arrival, first, last, time);
};
within = [begin, end];
if (ne(first, last)) {
[dx, dy] = iter([add(sub(ends.x, mul(last, ends.s)), mul(first, ends.s0)), sub(add(ends.y, mul(last, ends.c)), mul(first, ends.c0))]);
within = add(within, list(iter(kernel.time_within(dx, dy, wx, wy, 2.0))).filter((time) => (lt(begin, time) && lt(time, end))).map((time) => time));
}
found = sliced(sorted(within), 1, -1, null);
for ([a, b] of rows(pairwise(sorted(within)))) {
if ((ne(first, last) && lt(apart_at(arrival, first, last, mul(0.5, add(a, b))), 2.0))) {
continue;
}
steps = math.ceil(mul(2.0, sub(b, a)));
times = list(iter(range(add(steps, 1)))).map((i) => add(a, div(mul(sub(b, a), i), steps)));
values = list(iter(times)).map((time) => excess(time));
for (i of iter(range(steps))) {
if ((ge(item(values, i), 0.0) && gt(0.0, item(values, add(i, 1))) && gt(item(values, add(i, 1)), sub(item(values, i), math.pi)))) {
append_(found, root_between(excess, item(times, i), item(times, add(i, 1))));
}
}
}
return found;
}

function arc_crossings(arrival, first, halves, begin, end) {
let a, b, bends, dx, dy, ends, first_turn, half, inflection, slope, splits, turns, value, wx, wy;
[ends, wx, wy] = iter(arrival);
[dx, dy] = iter([sub(ends.x, mul(first, sub(ends.s, ends.s0))), add(ends.y, mul(first, sub(ends.c, ends.c0)))]);
half = sub(mul(math.pi, halves), mul(0.5, kernel.angle(kernel.arc_rotation(first, ends.c0, ends.s0, ends.c, ends.s))));
value = function (time) {
let across, x, y;
[x, y, across] = iter([sub(dx, mul(wx, time)), sub(dy, mul(wy, time)), math.sin(add(mul(0.5, half), mul(0.25, time)))]);
return sub(add(mul(x, x), mul(y, y)), mul(mul(16.0, across), across));
};
slope = function (time) {
return sub(mul(-2.0, add(mul(wx, sub(dx, mul(wx, time))), mul(wy, sub(dy, mul(wy, time))))), mul(4.0, math.sin(add(half, mul(0.5, time)))));
};
inflection = math.acos(add(mul(wx, wx), mul(wy, wy)));
first_turn = math.floor(div(add(half, mul(0.5, begin)), TWO_PI));
turns = range(sub(first_turn, 1), add(add(first_turn, math.ceil(div(mul(0.5, sub(end, begin)), TWO_PI))), 2));
bends = list(iter([neg(inflection), inflection])).flatMap((m) => list(iter(turns)).map((k) => mul(2.0, sub(add(m, mul(TWO_PI, k)), half))));
splits = [begin, ...iter(sorted(list(iter(bends)).filter((time) => (lt(begin, time) && lt(time, end))).map((time) => time))), end];
for ([a, b] of rows(pairwise(tuple(splits)))) {
if (lt(mul(slope(a), slope(b)), 0.0)) {
append_(splits, root_between(slope, a, b));
}
}
return list(iter(pairwise(sorted(splits)))).map((one) => iter(one)).filter(([a, b]) => (le(mul(value(a), value(b)), 0.0) && ne(value(b), 0.0))).map(([a, b]) => root_between(value, a, b));
}

function is_reachable(ends, wanted) {
return any(list(iter(stretches(ends))).map((stretch) => ge(turns_more(stretch, wanted, 0.0), 0)));
}

function falls_at(arrival, first, last, time) {
let _, dx, dy, ends, q1, q2, straight, wx, wy;
[ends, wx, wy] = iter([arrival.at(time), arrival.wx, arrival.wy]);
[dx, dy] = iter([add(sub(ends.x, mul(last, ends.s)), mul(first, ends.s0)), sub(add(ends.y, mul(last, ends.c)), mul(first, ends.c0))]);
if (eq(first, last)) {
straight = kernel.length(dx, dy);
return (gt(straight, 0.0) ? add(1.0, div(add(mul(wx, dx), mul(wy, dy)), straight)) : 2.0);
}
[_, q1, q2] = iter(kernel.tangent(first, dx, dy));
return add(add(1.0, mul(wx, q1)), mul(wy, q2));
}

function excess_of(arrival, first, last, time) {
let ends, pose, scene, wx, wy, x, y;
[ends, wx, wy] = iter(arrival);
scene = WindScene(0.0, 0.0, ends.c0, ends.s0, 1.0, wx, wy, 0.0);
[x, y] = iter([sub(ends.x, mul(wx, time)), sub(ends.y, mul(wy, time))]);
pose = SlotPose(time, time, x, y, ends.c, ends.s, 1.0, 0.0, 0.0);
return kernel.excess_at(first, last, pose, slots_Slot(1, 0.0), scene).value;
}

function _forbidden_left(zone) {
let area, following;
following = [...iter(sliced(zone.corners, 1, null, null)), item(zone.corners, 0)];
area = sum(list(iter(zip(zone.corners, following))).map((one) => iter(one)).map(([[x0, y0], [x1, y1]]) => sub(mul(x0, y1), mul(x1, y0))));
return (ne(gt(area, 0.0), zone.inclusion) ? zone.corners : sliced(zone.corners, null, null, -1));
}

function* _left_words(x, y, turned) {
let ahead, course, cross, far, first, half, last, left_x, left_y, right_x, right_y;
[left_x, left_y] = iter([sub(x, np.sin(turned)), sub(add(y, np.cos(turned)), 1.0)]);
[right_x, right_y] = iter([add(x, np.sin(turned)), sub(sub(y, np.cos(turned)), 1.0)]);
far = np.hypot(left_x, left_y);
ahead = np.where(lt(far, WHOLE_TURN), 0.0, np.arctan2(left_y, left_x));
yield [[1.0, 0.0, 1.0], [_arc(ahead), far, _arc(sub(turned, ahead))]];
cross = np.sqrt(sub(add(pow(right_x, 2), pow(right_y, 2)), 4.0));
course = add(np.arctan2(right_y, right_x), np.arctan2(2.0, cross));
yield [[1.0, 0.0, -1.0], [_arc(course), cross, _arc(sub(course, turned))]];
half = np.arccos(mul(0.25, far));
[first, last] = iter([_arc(add(add(ahead, half), mul(0.5, math.pi))), _arc(sub(add(sub(turned, ahead), half), mul(1.5, math.pi)))]);
yield [[1.0, -1.0, 1.0], [first, add(math.pi, mul(2.0, half)), last]];
}

const Word = struct(class extends Tuple {
constructor(to, control, length) {
super();
this.to = to;
this.control = control;
this.length = length;

}
}, ["to", "control", "length"], 'Word');

function* stretches(ends) {
let a, arcs, b, family, middle, one, other, spare, touching;
for (family of iter(families(ends))) {
spare = (eq(family.first, family.last) ? family.distance : sub(family.distance, 2.0));
touching = le(spare, mul(ROUNDING, add(add(1.0, abs(ends.x)), abs(ends.y))));
if (truth(touching)) {
arcs = (eq(family.first, family.last) ? on_one_circle(family) : on_touching_circles(family));
yield Stretch(family, 0.0, 0.0, arcs, arcs);
}
if ((le(spare, 0.0) || (truth(touching) && ne(family.first, family.last)))) {
continue;
}
for ([a, b] of rows(pairwise(breaks(family)))) {
middle = mul(0.5, add(a, b));
if (le(sub(b, a), ROUNDING)) {
continue;
}
[one, other] = iter([at_end(family, a, middle), at_end(family, b, middle)]);
if (le(one.length, other.length)) {
yield Stretch(family, a, b, one, other);
} else {
yield Stretch(family, b, a, other, one);
}
}
}
}

function turns_more(stretch, wanted, length_tolerance) {
let short, turns;
short = sub(sub(wanted, stretch.longest.length), length_tolerance);
turns = (gt(short, 0.0) ? math.ceil(div(short, TWO_PI)) : 0);
return (ge(sub(wanted, mul(TWO_PI, turns)), sub(stretch.shortest.length, length_tolerance)) ? turns : -1);
}

function path_within(stretch, wanted, length_tolerance) {
let _, high, low, middle;
if (le(wanted, add(stretch.shortest.length, length_tolerance))) {
return stretch.shortest;
}
if (ge(wanted, sub(stretch.longest.length, length_tolerance))) {
return stretch.longest;
}
[low, high] = iter([stretch.shorter, stretch.longer]);
for (_ of iter(range(elongation_HALVINGS))) {
middle = mul(0.5, add(low, high));
if (lt(path_at(stretch.family, middle).length, wanted)) {
low = middle;
} else {
high = middle;
}
}
return path_at(stretch.family, low);
}

function with_length(path, ends, wanted) {
let exact, first, k, last, middle, missing, t1, t2, t3, tolerance, turned;
[first, k, last, t1, t2, t3] = iter(path);
turned = math.atan2(sub(mul(ends.c0, ends.s), mul(ends.s0, ends.c)), add(mul(ends.c0, ends.c), mul(ends.s0, ends.s)));
missing = kernel.less_whole_turns(sub(sub(sub(turned, mul(first, t1)), mul(k, t2)), mul(last, t3)));
[tolerance, middle] = iter([mul(0.5, ROUNDING), sub(sub(wanted, t1), t3)]);
exact = (le(abs(sub(path.length, wanted)), mul(tolerance, add(1.0, wanted))) && le(abs(missing), tolerance));
if ((truth(exact) || le(middle, 0.0))) {
return path;
}
return replace(path, { curvature: max(-1.0, min(div(add(mul(k, t2), missing), middle), 1.0)), t2: middle });
}

function is_exact(path, ends, wanted, length_tolerance) {
let in_time, rounded;
rounded = mul(ROUNDING, add(add(add(1.0, abs(ends.x)), abs(ends.y)), wanted));
in_time = le(abs(sub(path.length, wanted)), mul(mul(0.5, ROUNDING), add(1.0, wanted)));
return and(and(in_time, () => le(abs(path.curvature), add(1.0, mul(0.5, ROUNDING)))), () => le(miss_of(path, ends), mul(2.0, max(length_tolerance, rounded))));
}

function* paths_at_edge(ends, wanted) {
let arc, azimuth, dx, dy, first, last, middle, t1, turned;
turned = math.atan2(sub(mul(ends.c0, ends.s), mul(ends.s0, ends.c)), add(mul(ends.c0, ends.c), mul(ends.s0, ends.s)));
for (first of iter([1, -1])) {
arc = mul(first, turned);
yield* iter(arc_and_straight(ends, wanted, first, mod(arc, TWO_PI)));
for (last of iter(within(mul(0.5, sub(wanted, arc)), math.pi, wanted))) {
yield ThreeArcs(first, 0.0, neg(first), sub(wanted, last), 0.0, last);
}
for (middle of iter(within(mul(0.5, sub(wanted, arc)), math.pi, wanted))) {
[dx, dy] = iter([sub(ends.x, mul(first, sub(ends.s, ends.s0))), add(ends.y, mul(first, sub(ends.c, ends.c0)))]);
azimuth = math.atan2(sub(mul(ends.c0, dy), mul(ends.s0, dx)), add(mul(ends.c0, dx), mul(ends.s0, dy)));
for (t1 of iter(within(add(mul(first, azimuth), mul(0.5, middle)), TWO_PI, sub(wanted, middle)))) {
yield ThreeArcs(first, neg(float(first)), first, t1, middle, sub(sub(wanted, middle), t1));
}
}
}
}

function apart_at(arrival, first, last, time) {
let c, c0, s, s0, x, y;
[c0, s0, x, y, c, s] = iter(arrival.at(time));
return kernel.length(add(sub(x, mul(last, s)), mul(first, s0)), sub(add(y, mul(last, c)), mul(first, c0)));
}

function root_between(function_, a, b) {
let _, middle, rises;
rises = lt(function_(a), 0.0);
for (_ of iter(range(elongation_HALVINGS))) {
middle = mul(0.5, add(a, b));
if (eq(lt(function_(middle), 0.0), rises)) {
a = middle;
} else {
b = middle;
}
}
return b;
}

const WindScene = struct(class extends Tuple {
constructor(x, y, c, s, R, wx, wy, arc_tolerance) {
super();
this.x = x;
this.y = y;
this.c = c;
this.s = s;
this.R = R;
this.wx = wx;
this.wy = wy;
this.arc_tolerance = arc_tolerance;

}
}, ["x", "y", "c", "s", "R", "wx", "wy", "arc_tolerance"], 'WindScene');

const SlotPose = struct(class extends Tuple {
constructor(width, time, x, y, c, s, advance, turning, turned) {
super();
this.width = width;
this.time = time;
this.x = x;
this.y = y;
this.c = c;
this.s = s;
this.advance = advance;
this.turning = turning;
this.turned = turned;

}
}, ["width", "time", "x", "y", "c", "s", "advance", "turning", "turned"], 'SlotPose');

const slots_Slot = struct(class extends Tuple {
constructor(side, phase) {
super();
this.side = side;
this.phase = phase;

}
}, ["side", "phase"], 'slots_Slot');

function _arc(angle) {
let within;
within = np.mod(angle, math.tau);
return np.where(gt(within, sub(math.tau, WHOLE_TURN)), 0.0, within);
}

function* families(ends) {
let distance, dx, dy, first, last, length_tolerance;
length_tolerance = mul(ROUNDING, add(add(1.0, abs(ends.x)), abs(ends.y)));
for ([first, last] of rows(OUTER_CONTROLS)) {
dx = sub(mul(neg(first), ends.s0), sub(ends.x, mul(last, ends.s)));
dy = sub(mul(first, ends.c0), add(ends.y, mul(last, ends.c)));
distance = kernel.length(dx, dy);
if ((eq(first, last) || ge(distance, sub(2.0, length_tolerance)))) {
yield Family(first, last, ends, distance, math.atan2(dy, dx));
}
}
}

function on_one_circle(family) {
let arc, ends, first;
[first, ends] = iter([family.first, family.ends]);
arc = kernel.angle(kernel.arc_rotation(first, ends.c0, ends.s0, ends.c, ends.s));
return ThreeArcs(first, float(first), first, arc, 0.0, 0.0);
}

function on_touching_circles(family) {
let _, azimuth, ends, first, last, nx, ny, t1;
[first, last, ends, _, azimuth] = iter(family);
[nx, ny] = iter([mul(first, math.cos(azimuth)), mul(first, math.sin(azimuth))]);
t1 = kernel.angle(kernel.arc_rotation(first, neg(ends.s0), ends.c0, nx, ny));
return ThreeArcs(first, 0.0, last, t1, 0.0, kernel.angle(kernel.arc_rotation(last, nx, ny, neg(ends.s), ends.c)));
}

const Stretch = struct(class extends Tuple {
constructor(family, shorter, longer, shortest, longest) {
super();
this.family = family;
this.shorter = shorter;
this.longer = longer;
this.shortest = shortest;
this.longest = longest;

}
}, ["family", "shorter", "longer", "shortest", "longest"], 'Stretch');

function breaks(family) {
let _, axis, distance, first, high, inside, last, low, straight, tightest, turned;
[first, last, _, distance, _] = iter(family);
axis = (gt(first, 0) ? 0.0 : math.pi);
[straight, tightest] = iter([mul(0.5, math.pi), math.acos(min(mul(0.25, distance), 1.0))]);
if (ne(first, last)) {
[straight, tightest] = iter([mul(2.0, math.asin(math.sqrt(div(mul(0.5, sub(distance, 2.0)), distance)))), 0.0]);
}
[low, high] = iter([add(axis, tightest), sub(add(axis, TWO_PI), tightest)]);
inside = [add(axis, straight), sub(axis, straight), without_first_arc(family), without_last_arc(family)];
turned = sorted(list(iter(inside)).map((a) => add(low, mod(sub(a, low), TWO_PI))));
return [low, ...iter(list(iter(turned)).filter((a) => (lt(low, a) && lt(a, high))).map((a) => a)), high];
}

function at_end(family, alpha, inside) {
let near, path, t1, t2, t3;
[path, near] = iter([path_at(family, alpha), path_at(family, add(alpha, mul(BESIDE, sub(inside, alpha))))]);
t1 = add(near.t1, kernel.less_whole_turns(sub(path.t1, near.t1)));
t3 = add(near.t3, kernel.less_whole_turns(sub(path.t3, near.t3)));
t2 = (gt(near.t2, div(1.0, BESIDE)) ? math.inf : path.t2);
return replace(path, { t1: max(t1, 0.0), t2: t2, t3: max(t3, 0.0) });
}

function path_at(family, alpha) {
let ahead, azimuth, beta, c1, c3, chord, chord_x, chord_y, distance, ends, first, half, last, left, s1, s3, t1, t2, t3;
[first, last, ends, distance, azimuth] = iter(family);
[c1, s1] = iter([math.cos(alpha), math.sin(alpha)]);
beta = last_normal(first, last, distance, alpha);
[c3, s3] = iter([math.cos(beta), math.sin(beta)]);
[chord_x, chord_y] = iter([sub(sub(mul(first, c1), mul(last, c3)), distance), sub(mul(first, s1), mul(last, s3))]);
[ahead, left] = iter([sub(mul(chord_x, s1), mul(chord_y, c1)), add(mul(chord_x, c1), mul(chord_y, s1))]);
[chord, half] = iter([kernel.length(chord_x, chord_y), math.atan2(abs(left), ahead)]);
t2 = ((eq(left, 0.0) && gt(0.0, ahead)) ? math.inf : (eq(left, 0.0) ? chord : div(mul(mul(chord, chord), half), abs(left))));
t1 = mul(first, sub(add(alpha, azimuth), math.atan2(ends.c0, neg(ends.s0))));
t3 = mul(last, sub(sub(math.atan2(ends.c, neg(ends.s)), azimuth), beta));
return ThreeArcs(first, curvature_at(family, alpha), last, mod(t1, TWO_PI), t2, mod(t3, TWO_PI));
}

function miss_of(path, ends) {
let c, chord, half, k, s, t, x, y;
[x, y, c, s] = iter([0.0, 0.0, ends.c0, ends.s0]);
for ([k, t] of rows([[float(path.first), path.t1], [path.curvature, path.t2], [float(path.last), path.t3]])) {
half = mul(mul(0.5, k), t);
chord = (ne(half, 0.0) ? div(mul(t, math.sin(half)), half) : t);
[c, s] = iter([sub(mul(c, math.cos(half)), mul(s, math.sin(half))), add(mul(s, math.cos(half)), mul(c, math.sin(half)))]);
[x, y] = iter([add(x, mul(chord, c)), add(y, mul(chord, s))]);
[c, s] = iter([sub(mul(c, math.cos(half)), mul(s, math.sin(half))), add(mul(s, math.cos(half)), mul(c, math.sin(half)))]);
}
return max(kernel.length(sub(x, ends.x), sub(y, ends.y)), kernel.length(sub(c, ends.c), sub(s, ends.s)));
}

function* arc_and_straight(ends, wanted, first, arc) {
let arc_is_first, c, dx, dy, s, t, turns;
for ([c, s, arc_is_first] of rows([[ends.c, ends.s, true], [ends.c0, ends.s0, false]])) {
[dx, dy] = iter([sub(ends.x, mul(first, sub(ends.s, ends.s0))), add(ends.y, mul(first, sub(ends.c, ends.c0)))]);
turns = math.floor(add(div(sub(sub(sub(wanted, arc), mul(dx, c)), mul(dy, s)), TWO_PI), 0.5));
t = max(0.0, min(add(arc, mul(TWO_PI, turns)), wanted));
if (truth(arc_is_first)) {
yield ThreeArcs(first, 0.0, first, t, sub(wanted, t), 0.0);
} else {
yield ThreeArcs(first, 0.0, first, 0.0, sub(wanted, t), t);
}
}
}

function within(angle_at, period, most) {
let least;
least = sub(angle_at, mul(period, math.floor(div(angle_at, period))));
return list(iter(range(-1, add(1, int(add(div(TWO_PI, period), 0.5)))))).map((i) => max(0.0, min(add(least, mul(period, i)), most)));
}

const ThreeArcs = struct(class extends Tuple {
constructor(first, curvature, last, t1, t2, t3) {
super();
this.first = first;
this.curvature = curvature;
this.last = last;
this.t1 = t1;
this.t2 = t2;
this.t3 = t3;

}
get length() {
const self = this;
return add(add(self.t1, self.t2), self.t3);
}
get turning() {
const self = this;
return add(add(self.t1, mul(abs(self.curvature), self.t2)), self.t3);
}
}, ["first", "curvature", "last", "t1", "t2", "t3"], 'ThreeArcs');

const Family = struct(class extends Tuple {
constructor(first, last, ends, distance, azimuth) {
super();
this.first = first;
this.last = last;
this.ends = ends;
this.distance = distance;
this.azimuth = azimuth;

}
}, ["first", "last", "ends", "distance", "azimuth"], 'Family');

function without_first_arc(family) {
return sub(math.atan2(family.ends.c0, neg(family.ends.s0)), family.azimuth);
}

function without_last_arc(family) {
let azimuth, distance, ends, first, last;
[first, last, ends, distance, azimuth] = iter(family);
return add(last_normal(last, first, distance, sub(sub(math.atan2(ends.c, neg(ends.s)), azimuth), math.pi)), math.pi);
}

function last_normal(first, last, distance, alpha) {
let along, beside, spare;
if (eq(first, last)) {
return sub(math.pi, alpha);
}
[spare, beside] = iter([sub(distance, 2.0), beside_axis(first, alpha)]);
along = mul(first, sub(mul(add(mul(distance, distance), 4.0), beside), mul(spare, spare)));
return math.atan2(mul(mul(spare, add(distance, 2.0)), math.sin(alpha)), along);
}

function curvature_at(family, alpha) {
let _, beside, distance, first, last, spare;
[first, last, _, distance, _] = iter(family);
if (eq(first, last)) {
return div(mul(2.0, math.cos(alpha)), or(sub(mul(mul(2.0, first), math.cos(alpha)), distance), () => neg(math.inf)));
}
[spare, beside] = iter([sub(distance, 2.0), beside_axis(first, alpha)]);
return div(mul(mul(-2.0, first), sub(spare, mul(distance, beside))), or(mul(distance, add(spare, mul(2.0, beside))), () => math.inf));
}

function beside_axis(first, alpha) {
let half;
half = (gt(first, 0) ? math.sin(mul(0.5, alpha)) : math.cos(mul(0.5, alpha)));
return mul(mul(2.0, half), half);
}

const STYLES = new Map([["L", "ff739e00"], ["S", "ffb27200"], ["R", "ff005ed5"], ["circle", "ff000000"]]);
const SCHEMA = "http://www.w3.org/2001/XMLSchema-instance";
const NAMESPACE = "http://www.topografix.com/GPX/1/1";
const DEGREES = ".9f";
const VIEW_DISTANCE = 3.0;
const MAX_VERTICES = 1000000;
const AREA_VERSION = 1;
const FENCE_VERSION = 2;
const NO_FENCE = new Map([["circles", []], ["polygons", []], ["version", 2]]);
const FIXED_WING = 1;
const MARK = "QGC WPL";
const HEADER = `${str(MARK)} 110`;
const ACTIONS = new Map([["L", "turn left"], ["S", "fly straight"], ["R", "turn right"]]);
const DECIMALS = 9;
const LEAST_SIZE = 1e-50;
const LARGEST_SIZE = 1e+50;
const ALTITUDE_MODES = new Map([[Frame.ABOVE_SEA, 2], [Frame.ABOVE_HOME, 1], [Frame.ABOVE_TERRAIN, 4]]);
const UNITS = new Map([[AltitudeReference.MSL, "metres above mean sea level"], [AltitudeReference.HOME, "metres above home"], [AltitudeReference.GROUND, "metres above the ground"]]);
const FRAMES = new Map([[AltitudeReference.MSL, Frame.ABOVE_SEA], [AltitudeReference.HOME, Frame.ABOVE_HOME], [AltitudeReference.GROUND, Frame.ABOVE_TERRAIN]]);
const HIGHEST_ITEM_M = 83000.0;
const MEAN_SEA_LEVEL = AltitudeDatum();
const NO_PARAMS = [0.0, 0.0, 0.0, 0.0];
const LEAST_EARTH_RADIUS_M = 6335439.0;
const LARGEST_LATITUDE_DEG = 89.99;
const REACH_M = 100000.0;
const BEND_PER_M = div(mul(div(2.0, 3.0), REACH_M), pow(LEAST_EARTH_RADIUS_M, 2));
const places_DECIMALS = 12;
const LEAST_SIDES = 72;
const CONTROLS = new Map([["L", 1], ["S", 0], ["R", -1]]);
const CALM = Wind(0.0, 0.0);
const MAX_SAMPLES = 10000000;
const LEAST_RADIUS_M = 1.0;
const LARGEST_RADIUS_M = 65535.0;
const MAX_ITEMS = 700;
const LEAST_STRAIGHT_S = 2.0;
const TAKE_OVER_S = 3.5;
const LARGEST_ACCEPTANCE_M = 255.0;
const UPWIND = 0.0;
const DOWNWIND = math.pi;
const SIDES = new Map([[Turn.CW, kernel.Side.CW], [Turn.CCW, kernel.Side.CCW], [Turn.EITHER, kernel.Side.EITHER]]);
const ROUNDING = mul(64.0, pow(2.0, -52));
const COMMANDS = new Map([[MavCommand.NAV_LOITER_UNLIM, CircleParameters(3)], [MavCommand.NAV_LOITER_TURNS, CircleParameters(3)], [MavCommand.NAV_LOITER_TIME, CircleParameters(3)], [MavCommand.NAV_LOITER_TO_ALT, CircleParameters(2)], [MavCommand.DO_ORBIT, CircleParameters(1)], [MavCommand.DO_REPOSITION, CircleParameters(3, 4)]]);
const TURN_LIMITS = new Map([["max_bank_deg", "degrees"], ["min_turn_radius_m", "metres"], ["max_turn_rate_deg_s", "degrees per second"]]);
const STANDARD_GRAVITY_M_S2 = 9.80665;
const FILE_FORMATS = [Format([".geojson"], "map", "application/geo+json", "GeoJSON", "for maps", partial(_map, geojson, false)), Format([".kml"], "map", "application/vnd.google-earth.kml+xml", "KML", "for Google Earth", partial(_map, kml, true)), Format([".gpx"], "map", "application/gpx+xml", "GPX", "for GPS receivers", partial(_map, gpx, false)), Format([".csv"], "table", "text/csv; charset=utf-8", "CSV", "samples along the track, in metres", _table), Format([".plan"], "mission", "application/json", "Plan", "mission for QGroundControl", _plan), Format([".waypoints", ".txt"], "mission", "text/plain; charset=utf-8", "WPL", "waypoints for Mission Planner", _waypoints)];
const AUTOPILOTS = new Map([["ardupilot", Autopilot.ARDUPILOT], ["px4", Autopilot.PX4]]);
const SCENE_FIELDS = bit_or(new Map(list(iter(["airspeed_m_s", ...iter(TURN_LIMITS)])).map((name) => [name, SceneField(`aircraft.${str(name)}`, `aircraft/${str(name)}`)])), new Map([["turn", SceneField("orbit.turn", "orbit/turn")], ["turn limit", SceneField("the turn limit of the aircraft", "aircraft")], ["turn radius", SceneField("the turn radius of the aircraft", "aircraft")], ["frame", SceneField("origin", "origin")]]));
const NARROW = 1e-06;
const SHARE = 0.437;
const JUMP = 0.001;
const LARGEST_GAP = 3.0;
const VANISHING = 0.001;
const STEPS = 100;
const LAP_STEPS = 120;
const LEAST_CORNERS = 3;
const TOUCH_M = 1e-06;
const MAX_POINTS = 20000;
const REACH = pow(2.0, 52);
const WIDTH = 480.0;
const THIN = 1.5;
const CHORD_ERROR = 0.002;
const OPTIONS = new Map([["pose", "--pose"], ["orbit", "--orbit"], ["turn", "--turn"], ["airspeed_m_s", "--airspeed"], ["max_bank_deg", "--bank"], ["min_turn_radius_m", "--turn-radius"], ["max_turn_rate_deg_s", "--turn-rate"], ["wind", "--wind"], ["orbit_velocity_m_s", "--orbit-velocity"], ["tolerance_m", "--tolerance"], ["exit_to", "--exit-to"], ["hold_s", "--hold"], ["turns", "--turns"], ["start_altitude_m", "--altitude"], ["altitude_m", "--to-altitude"], ["climb_rate_m_s", "--climb-rate"], ["descent_rate_m_s", "--descent-rate"], ["slot phase_deg", "--slot"], ["slot at_s", "--slot-at"]]);
const IN_STILL_AIR = Formulation([Condition("target", "x(T) = 0, y(T) = R or -R (8)-(10)", target), Condition("join", "the last pose, reduced by (2), is the target", join), Condition("turn", "the circle is held as asked for", turn)], [EquationOfMotion("motion", "x' = 1 + u y, y' = -u x (7)", ((now) => now.reduced), ((piece, now) => sub(1.0, mul(mul(new Complex(0.0, 1.0), piece.u), now.reduced)))), EquationOfMotion("adjoint", "psi1' = u psi2, psi2' = -u psi1 (12)", ((now) => now.psi), ((piece, now) => mul(mul(neg(new Complex(0.0, 1.0)), piece.u), now.psi))), EquationOfMotion("slope", "phi' = -psi2 (17)", ((now) => now.phi), ((piece, now) => neg(now.psi2)))], new Map([["norm", "|psi| = 1 (18)"], ["multiplier", "lambda >= 0"], ["sign", "u = sign phi, u = 0 only where phi = 0 (13)"], ["hamiltonian", "|phi| + psi1 = lambda (14)"], ["psi1", "psi1 <= lambda (16)"], ["transversality", "psi1(T) (1 + u side R) = lambda"]]), [Condition("switch", "phi = 0, psi1 = lambda at each switch", switch_), Condition("middle arc", "lasts 2 pi - 2 acos lambda, more than pi", middle_arc), Condition("slopes", "x1/y1 = -x/y (19)", slopes), Condition("line", "y = 0 while u = 0: a line through the centre", line), Condition("axis", "|psi2| times the |y| reached beyond = 0 where y changes sign", axis), Condition("last arc", "lasts pi/3 at most", partial(last_arc, { tight: true })), Condition("last arc", "lasts acos(1/(1 + R)) at most", partial(last_arc, { tight: false }))], GradientEquations("lambda grad T = -psi", "1 + min grad T . f = 0"));
const IN_WIND = Formulation([Condition("target", "|q(T)| = R", distance_from_circle), Condition("course", "q.(e + w) = 0 at T: along the circle (1)", course), Condition("join", "the last pose over the ground is where the circle is then", conditions_join), Condition("turn", "the circle is held as asked for", turn_as_flown)], [EquationOfMotion("motion", "q' = e + w", ((now) => now.q), ((piece, now) => add(now.e, piece.w))), EquationOfMotion("turning", "e' = u J e", ((now) => now.e), ((piece, now) => mul(mul(new Complex(0.0, 1.0), piece.u), now.e))), EquationOfMotion("slope", "f' = -p.Je", ((now) => now.phi), ((piece, now) => neg(now.psi2)))], new Map([["norm", "|p| = 1"], ["multiplier", "lambda + p.w >= 0 (4)"], ["sign", "u = sign f, u = 0 only where f = 0 (4)"], ["hamiltonian", "|f| + p.e = lambda (4)"], ["transversality", "p.(e + w) + u h k (lambda - p.e) = 0 at T (5)"]]), [], GradientEquations("(lambda + p.w) grad T = -(p, f)", "1 + min grad T . (e + w, u) = 0"));
const HOLD_LETTERS = new Map([[Turn.CW, "R"], [Turn.CCW, "L"]]);
const SAME_CORNER_M = 1e-06;
const LEAST_MARGIN_M = 5.0;
const MARGIN_SHARE = 0.05;
const TWO_PI = mul(2.0, math.pi);
const MOST_TURNS = 100000.0;
const ARC_POINTS = 48;
const MARGIN = 0.08;
const FLATTEST = 0.35;
const STEEPEST = 1.0;
const ARROW = 6.0;
const COLOURS = new Map([["L", "#009E73"], ["S", "#0072B2"], ["R", "#D55E00"]]);
const THICK = 3.0;
const drawing_MARK = 4.5;
const AIRCRAFT = 18.0;
const BASIS_VIOLATED = "a condition is violated";
const BASIS_THEOREM = "evidence/docs/proof.md, theorem 1, up to rounding";
const BASIS_NECESSARY = "necessary conditions only";
const ON_THE_CIRCLE = "the start is on the circle: there is nothing to decide, and the target is all there is to check";
const ARC_IN_WIND = "a single arc has many adjoints: this is the one that violates the conditions least";
const UNIQUE_IN_WIND = "the adjoint is unique: the pieces and the condition at the circle determine it";
const UNIQUE = "the adjoint psi is unique: the condition phi = 0 at a switch determines it";
const ARC_BY_ROUNDING = "a single arc (the other is there by rounding alone)";
const STRAIGHT_ENTRY = "that of a straight entry that ends in it, (1, 0) on the axis";
const SWITCH_AT_START = "that of a switch at its start, parallel to the state there";
const LETTERS = new Map(list(iter(items_(CONTROLS))).map((one) => iter(one)).map(([letter, u]) => [u, letter]));
const HERE = Slot(0.0);
const BASIS_SLOT = "an extremal into the slot; that no path arrives earlier is cross-checked by an independent method";
const STARTS_IN_SLOT = "the start is in the slot: there is nothing to decide, and the target is all there is to check";
const LINE = "the adjoint is unique: it is along the straight piece";
const BISECTOR = "the adjoint is unique: the two switches determine it";
const ANY = "fewer than two switches have many adjoints: this is one";
const DOUBLE_ROOT = 8.0;
const REACHED = 1e-12;
const CHORD_RAD = 0.1;
const PARTS = new Map([["enter", "ff005ed5"], ["hold", "ff000000"], ["leave", "ffb27200"]]);
const MOST_LEVELS = 16;
const SPLIT = 12;
const FIRST_PART_RAD = 0.8;
const RESOLUTION_M = mul(0.1, TOUCH_M);
const KNOT = div(1852.0, 3600.0);
const TURNS = new Map(list(iter(items_(SIDES))).map((one) => iter(one)).map(([turn, side]) => [side, turn]));
const _MESSAGES = new Map([[kernel.Status.OK, "solved"], [kernel.Status.NOT_FINITE, "the state, the radius or the wind is nan or infinite"], [kernel.Status.RADIUS_TOO_SMALL, "the circle is tighter than the minimum turn radius"], [kernel.Status.OUT_OF_RANGE, "the state or the radius is beyond 2**52 turn radii, where a double cannot resolve one turn, or a place on Earth is more than 100 km away"], [kernel.Status.BAD_TOLERANCE, "the tolerance must be zero or positive, and below 2**52 turn radii"], [kernel.Status.BAD_AIRCRAFT, "airspeed and turn limit must be positive, finite numbers, and a bank below 90 degrees"], [kernel.Status.BAD_ORBIT, "the circle needs a finite centre and velocity, and a positive, finite radius"], [kernel.Status.BAD_TURN, "the turn must be cw, ccw or either"], [kernel.Status.BAD_POSE, "the position and the heading must be finite numbers, and latitudes within 90 degrees"], [kernel.Status.MALFORMED, "the line has more or fewer fields than the header, an open quote, is too long, or is not UTF-8"], [kernel.Status.WIND_TOO_STRONG, "the wind relative to the circle is as fast as the aircraft: |w| must be below 1"], [kernel.Status.NOT_HELD, "the circle is too tight to be held in this wind"], [kernel.Status.NOT_CONVERGED, "no maneuver was found that ends on the circle when flown"], [kernel.Status.BAD_WIND, "the wind needs a finite speed, zero or positive, and a finite direction"], [kernel.Status.BAD_SLOT, "the slot needs a finite bearing, and a finite time within 100,000 turns of the start"]]);
const WIND_TIE_TOLERANCE = 1e-12;
const NOT_CLAIMED = "the maneuver is not proved to be optimal";
const NOT_PLANNED = "not proved: another maneuver, as fast up to rounding, is the plan";
const UNIT = pow(2.0, -52);
const OF_SECONDS = pow(2.0, -50);
const BY_THEOREMS = "evidence/docs/bridging.md, theorems 5 and 6, for the reduced state";
const STEP = pow(2.0, -15);
const BESIDE_LAST_ARC = "the tolerance counts the start as on the last arc, but T without a tolerance does not";
const SHORT = 0.0001;
const BEGIN = 129;
const FINEST = 1e-09;
const MOST_STATES = 12000;
const legs_MOST_TURNS = 255;
const LARGEST_TURNS_RADIUS_M = 255.0;
const FROM_EXIT = 1.0;
const HEADING_REQUIRED = 1.0;
const SAMPLES = 9;
const NO_FOLD = pow(2.0, -150);
const MISS = 256.0;
const WIDE = pow(2.0, 44);
const LATE = 256.0;
const LATE_BEYOND = 1024.0;
const OF_D = pow(2.0, -39);
const MISS_OF_LRL = 2048.0;
const LATE_OF_LRL = 1024.0;
const STRAIGHTENS = 0.85;
const RESOLVED = 0.001;
const AT_CORNER = "T has a corner: its one-sided derivatives";
const PIECES = 256;
const PASSES = 60;
const MOST_TIMES = 50000;
const slot_check_SAMPLES = 2001;
const NEAR = 0.001;
const MINIMA = 20;
const ZOOMS = 12;
const MOST_HELD = mul(100000.0, math.tau);
const SAME_TIME = 1e-09;
const STILL_AIR_GAP_M = mul(10.0, TOUCH_M);
const CHORD_ERROR_M = 0.01;
const WIND_GAP_M = mul(2.1, CHORD_ERROR_M);
const WIDER = [0.2, 0.5];
const clear_entry_PASSES = [1, 2];
const clear_entry_LATE = 1.0;
const clear_entry_NEAR = 0.05;
const SLACK = 0.5;
const LATTICE_STEPS = [0.25, 0.12, 0.06, 0.03];
const MOST_PIECES = 12;
const LEAST_GAIN_M = 0.01;
const MOST_CHAINS = 4;
const MOST_POSES = 1500;
const MOST_POSES_IN_WIND = 60;
const HALVINGS = 14;
const TANGENT_STEPS = 5;
const clear_entry_LETTERS = new Map(list(iter(items_(CONTROLS))).map((one) => iter(one)).map(([letter, control]) => [float(control), letter]));
const NO_LENGTH_M = 1e-100;
const SCANNED_DIRECTIONS = 720;
const STEPS_IN_STILL_AIR = tuple(list(iter(range(4, 34))).map((k) => pow(2.0, neg(k))));
const STEPS_IN_WIND = [pow(2.0, -6), pow(2.0, -9), pow(2.0, -12), pow(2.0, -15)];
const CLOSING = 8.0;
const LONGER_PATHS = 49;
const BETWEEN_JOINS = div(math.tau, 24.0);
const SAME_TIME_S = 0.05;
const MOST_ROUNDS = 3;
const MOST_ENTRY = 3;
const LAST_CHANGE = 0.0005;
const FIRST_CHANGE = 0.1;
const MOST_SWEEPS = 30;
const ENOUGH = 0.02;
const NO_PIECE_M = 1e-08;
const UNKNOWN = -1;
const CLEAR = 1;
const BATCH = 48;
const LONGEST = 1000000.0;
const MOST_WINDOWS = 200;
const WINDOW = 8.0;
const JOINS = 48;
const LINE_STEP = 0.5;
const MOST_ON_LINE = 24;
const ARC_STEP_RAD = div(math.pi, 12.0);
const MOST_IN_TURN = 100000;
const SIX_CONTROLS = [[1.0, 0.0, 1.0], [-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, -1.0, 1.0], [-1.0, 1.0, -1.0]];
const SIX = list(iter(SIX_CONTROLS)).map((one) => iter(one)).map(([u, v, w]) => arrays.encode(int(u), int(v), int(w)));
const lattice_MOST_POSES = 4000;
const lattice_BATCH = 64;
const SAME_ENTRY = 1e-06;
const CELL = 0.5;
const SPAN = pow(2, 20);
const NEIGHBOURS = 6;
const DENSE = 32;
const PIECE_M = 0.001;
const OUTER_CONTROLS = [[1, 1], [-1, -1], [1, -1], [-1, 1]];
const ABSENT = -2;
const MOST_AT_ONCE = 1000000;
const SAME_LENGTH = 1e-09;
const WHOLE_TURN = 1e-09;
const elongation_HALVINGS = 70;
const BESIDE = 1e-07;

export { plan, certificate, first_maneuver, lap, leg_plan, leg_fence_check, leg_file, fence_check, clear_plan, clear_maneuver, CircleZone, PolygonZone, Fence, check_points, FILE_FORMATS, SaveArguments, AltitudeDatum, AUTOPILOTS, SCENE_FIELDS, Pose, Orbit, Aircraft, Wind, Problem, Slot, slot_pose, heading_vector, Maneuver, drawn_svg, LocalFrame, PlacedProblem, _kind, NARROW, SHARE, JUMP, LARGEST_GAP, VANISHING };
