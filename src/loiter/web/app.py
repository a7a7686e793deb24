"""The service as an ASGI application: endpoints over the library, problem documents, limits and headers."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal
from urllib.parse import urlsplit

from fastapi import Depends, FastAPI, HTTPException, Query, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import ValidationError
from starlette.middleware.cors import CORSMiddleware
from starlette.types import ASGIApp, Receive, Scope, Send

from loiter.errors import InvalidArgument
from loiter.planning.model import TurnName
from loiter.version import __version__
from loiter.web import models, problems
from loiter.web.answers import exports, plans
from loiter.web.answers.synthesis import DEFAULT_CELLS, MAX_CELLS, synthesis
from loiter.web.headers import LoopbackHosts, SecurityHeaders, map_headers
from loiter.web.limits import Limits
from loiter.web.pool import BoundedPool

SUMMARY = "The fastest way onto a holding circle for a fixed-wing aircraft."

STATIC = Path(__file__).with_name("static")

if TYPE_CHECKING:
    Format = str
else:
    Format = Literal[tuple(exports.FORMATS)]

# More threads would not be faster; each one lets one more slow request run beside the others.
THREADS, MAX_REQUESTS = 4, 128

# Pictures are drawn one at a time, some 0.3 s each.
MAX_PICTURES = 16


def create_app(cors: str | None = None, loopback_host: str | None = None) -> ASGIApp:
    """The service as an ASGI application; `cors` is the one other origin whose pages may use it.

    With `loopback_host`, the address that a server on loopback listens on, requests for other hosts are refused.
    """
    api = FastAPI(
        title="loiter",
        version=__version__,
        summary=SUMMARY,
        responses=problems.REFUSALS,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
    )
    problems.install(api)
    pool = BoundedPool(THREADS, MAX_REQUESTS)
    _add_plans(api, pool)
    _add_maps(api, pool)
    _add_exports(api, pool, BoundedPool(1, MAX_PICTURES))
    _add_page(api)
    app: ASGIApp = Limits(api)
    if cors is not None:
        app = CORSMiddleware(app, [cors], allow_methods=["GET", "POST"], allow_headers=["content-type"])
    if loopback_host is not None:
        app = LoopbackHosts(app, loopback_host)
    return SecurityHeaders(_without_ranges(app))


def _without_ranges(app: ASGIApp) -> ASGIApp:
    """The app without Range headers, so that it sends whole files; a bad range would be refused in plain text."""

    async def serve_whole(scope: Scope, receive: Receive, send: Send) -> None:
        headers = [(name, value) for name, value in scope["headers"] if name != b"range"]
        await app({**scope, "headers": headers}, receive, send)

    return serve_whole


async def require_json(request: Request) -> None:
    """Refuse a body whose content type is not JSON."""
    content_type, _, _ = request.headers.get("content-type", "").partition(";")
    if content_type.strip().lower() != "application/json":
        raise HTTPException(415, "the body must be of the type application/json")


JSON_BODY = [Depends(require_json)]


def _add_plans(api: FastAPI, pool: BoundedPool) -> None:
    @api.post("/api/plan", response_model=models.Plan, response_model_exclude_unset=True, dependencies=JSON_BODY)
    async def plan(scene: models.Scene) -> Any:
        """The fastest entry and all alternatives with their cost: the JSON of `loiter plan --json`, with tracks."""
        return await pool.run(plans.plan, scene.placed())

    @api.post(
        "/api/candidates", response_model=models.Candidates, response_model_exclude_unset=True, dependencies=JSON_BODY
    )
    async def candidates(scene: models.Scene) -> Any:
        """Every extremal for the requested turn direction, fastest first."""
        return await pool.run(plans.all_candidates, scene.placed())

    @api.post("/api/certificate", response_model=models.Proof, dependencies=JSON_BODY)
    async def certificate(scene: models.Scene) -> Any:
        """The certificate of the first optimal maneuver: each condition of the maximum principle, checked."""
        return await pool.run(plans.certificate, scene.placed())


def _add_maps(api: FastAPI, pool: BoundedPool) -> None:
    @api.get("/api/synthesis", response_model=models.Synthesis)
    async def map_(
        radius: Annotated[
            float, Query(description="Radius of the circle, turn radii.", json_schema_extra={"minimum": 1})
        ] = 1,
        turn: TurnName = "either",
        reach: Annotated[
            float | None,
            Query(description="Half the side of the map, turn radii; radius + 3 if absent."),
        ] = None,
        cells: Annotated[
            int, Query(ge=8, le=MAX_CELLS, description="Grid points along a side; rounded up to an even number.")
        ] = DEFAULT_CELLS,
    ) -> Response:
        """The optimal synthesis of the reduced plane: the fastest word in each region, and the curves between them."""
        encoded = await pool.run(lambda query: synthesis(*query), (radius, turn, reach, cells))
        return Response(encoded, media_type="application/json")

    @api.get("/healthz", response_model=models.Health)
    async def health() -> Any:
        """Whether the service is running, and its version."""
        return {"status": "ok", "version": __version__}


def _add_exports(api: FastAPI, pool: BoundedPool, picture_pool: BoundedPool) -> None:
    content: dict[str, dict[str, Any]] = {
        _without_parameters(known.media_type): {} for known in exports.FORMATS.values()
    }
    described: dict[int | str, dict[str, Any]] = {
        200: {"description": "The file, as an attachment.", "content": content}
    }

    async def attachment(format_: str, options: models.ExportOptions) -> Response:
        options.placed()
        wanted = exports.FORMATS[format_]
        suitable_pool = picture_pool if wanted.kind == "picture" else pool
        file = await suitable_pool.run(exports.export, exports.ExportRequest(format_, options))
        headers = {"content-disposition": f'attachment; filename="entry.{format_}"'}
        return Response(file, media_type=wanted.media_type, headers=headers)

    @api.post("/api/export/{format}", response_class=Response, responses=described, dependencies=JSON_BODY)
    async def export(format: Format, options: models.ExportOptions) -> Response:
        """The plan as a file."""
        return await attachment(format, options)

    @api.get("/api/export/{format}", response_class=Response, responses=described)
    async def export_link(
        format: Format,
        scene: Annotated[str, Query(description="The body of the POST request of the same path, as JSON.")],
    ) -> Response:
        """The plan as a file, for links: the scene is a parameter of the address."""
        return await attachment(format, _options_of_link(scene))


def tile_origin(template: str) -> str:
    """The origin of a tile server; raises `InvalidArgument` unless `template` is a URL with {z}, {x} and {y}."""
    problem = "it must be a URL with {z}, {x} and {y}, such as https://tile.openstreetmap.org/{z}/{x}/{y}.png"
    try:
        parts = urlsplit(template)
        host, port = parts.hostname or "", parts.port
    except ValueError:
        raise InvalidArgument("tiles", f"is {template!r}: {problem}") from None
    # The origin becomes part of a header: nothing but a plain host name may enter it.
    # `urlsplit` drops line breaks and tabs: they would otherwise come back in the page.
    printable = template.isascii() and template.isprintable() and " " not in template
    known = (
        printable
        and parts.scheme in ("http", "https")
        and re.fullmatch(r"[A-Za-z0-9.-]+|[0-9A-Fa-f:]*:[0-9A-Fa-f:.]*", host)
    )
    if not known or not all(part in f"{parts.path}?{parts.query}" for part in ("{z}", "{x}", "{y}")):
        raise InvalidArgument("tiles", f"is {template!r}: {problem}")
    name = f"[{host}]" if ":" in host else host
    return f"{parts.scheme}://{name}" + (f":{port}" if port is not None else "")


def _without_parameters(media_type: str) -> str:
    name, _, _ = media_type.partition(";")
    return name


def _options_of_link(scene: str) -> models.ExportOptions:
    try:
        return models.ExportOptions.model_validate_json(scene)
    except ValidationError as error:
        errors = [one | {"loc": ("query", "scene", *one["loc"])} for one in error.errors(include_url=False)]
        raise RequestValidationError(errors) from error


def _add_page(api: FastAPI) -> None:
    @api.api_route("/", methods=["GET", "HEAD"], include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(STATIC / "index.html")

    @api.get("/map.html", include_in_schema=False)
    async def map_tiles(tiles: str) -> FileResponse:
        """The document behind the plan view that draws map tiles, once the user has switched them on."""
        return FileResponse(STATIC / "map.html", headers=map_headers(tile_origin(tiles)))

    api.mount("/static", StaticFiles(directory=STATIC))
