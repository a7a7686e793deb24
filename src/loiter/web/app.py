"""The service assembled: endpoints, errors, limits and headers around the library's answers."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from fastapi import Depends, FastAPI, HTTPException, Query, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import ValidationError
from starlette.middleware.cors import CORSMiddleware
from starlette.types import ASGIApp, Receive, Scope, Send

from loiter.planning.model import TurnName
from loiter.version import __version__
from loiter.web import models, openapi, problems
from loiter.web.answers import exports, plans
from loiter.web.answers.synthesis import FIRST_CELLS, MOST_CELLS, synthesis
from loiter.web.headers import Headers
from loiter.web.limits import Limits
from loiter.web.workers import Workers

STATIC = Path(__file__).with_name("static")

Format = Literal["geojson", "kml", "gpx", "csv", "plan", "waypoints", "png", "svg"]

# More threads would not be faster, and each lets one more request that takes long go on beside the others.
THREADS, PLACES = 4, 128

# Pictures are drawn one at a time, some 0.3 s each.
PICTURES = 16


def create_app(cors: str | None = None) -> ASGIApp:
    """The service as an ASGI application; `cors` is the one other origin whose pages may ask it."""
    api = FastAPI(title="loiter", version=__version__, docs_url=None, redoc_url=None, redirect_slashes=False)
    problems.install(api)
    openapi.install(api)
    workers = Workers(THREADS, PLACES)
    _plans(api, workers)
    _maps(api, workers)
    _files(api, workers, Workers(1, PICTURES))
    _page(api)
    app: ASGIApp = Limits(api)
    if cors is not None:
        app = CORSMiddleware(app, [cors], allow_methods=["GET", "POST"], allow_headers=["content-type"])
    return Headers(_whole(app))


def _whole(app: ASGIApp) -> ASGIApp:
    """Answers are given whole: of ranges the framework would refuse a bad one in plain text."""

    async def asked(scope: Scope, receive: Receive, send: Send) -> None:
        headers = [(name, value) for name, value in scope["headers"] if name != b"range"]
        await app({**scope, "headers": headers}, receive, send)

    return asked


async def only_json(request: Request) -> None:
    """Refuse a body that does not say it is JSON."""
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/json":
        raise HTTPException(415, "the body must be of the type application/json")


JSON = [Depends(only_json)]


def _plans(api: FastAPI, workers: Workers) -> None:
    @api.post("/api/plan", response_model=models.Plan, response_model_exclude_unset=True, dependencies=JSON)
    async def plan(scene: models.Scene) -> Any:
        """The fastest entry, and every other with what it costs: what `loiter plan --json` prints, with tracks."""
        return await workers.run(plans.plan, scene.placed())

    @api.post("/api/fastest", response_model=models.Plan, response_model_exclude_unset=True, dependencies=JSON)
    async def fastest(scene: models.Scene) -> Any:
        """The fastest entry, of the others only the best the other way round; in wind in half the time."""
        return await workers.run(plans.fastest, scene.placed())

    @api.post("/api/candidates", response_model=models.Candidates, response_model_exclude_unset=True, dependencies=JSON)
    async def candidates(scene: models.Scene) -> Any:
        """Every extremal for the turn asked for, fastest first."""
        return await workers.run(plans.every, scene.placed())

    @api.post("/api/certificate", response_model=models.Proof, dependencies=JSON)
    async def certificate(scene: models.Scene) -> Any:
        """The certificate of the first optimal maneuver: the maximum principle, condition by condition."""
        return await workers.run(plans.proof, scene.placed())


def _maps(api: FastAPI, workers: Workers) -> None:
    @api.get("/api/synthesis", response_model=models.Synthesis)
    async def map_(
        radius: Annotated[float, Query(description="The circle's, turn radii.", json_schema_extra={"minimum": 1})] = 1,
        turn: TurnName = "either",
        reach: Annotated[
            float | None,
            Query(description="How far the map reaches, turn radii; radius + 3 if absent."),
        ] = None,
        cells: Annotated[int, Query(ge=8, le=MOST_CELLS, description="Along a side; made even.")] = FIRST_CELLS,
    ) -> Response:
        """The optimal synthesis of the reduced plane: which word wins where, and the curves between the regions."""
        encoded = await workers.run(lambda given: synthesis(*given), (radius, turn, reach, cells))
        return Response(encoded, media_type="application/json")

    @api.get("/healthz", response_model=models.Health)
    async def health() -> Any:
        """Whether the service is there."""
        return {"status": "ok", "version": __version__}


def _files(api: FastAPI, workers: Workers, artists: Workers) -> None:
    media: dict[str, dict[str, Any]] = {
        kind.partition(";")[0]: {} for kind in {**exports.FILES, **exports.PICTURES}.values()
    }
    told: dict[int | str, dict[str, Any]] = {200: {"description": "The file, as an attachment.", "content": media}}

    async def file(format_: str, options: models.ExportOptions) -> Response:
        options.placed()
        crew = artists if format_ in exports.PICTURES else workers
        content = await crew.run(exports.maker(format_), exports.Export(format_, options))
        headers = {"content-disposition": f'attachment; filename="entry.{format_}"'}
        return Response(content, media_type={**exports.FILES, **exports.PICTURES}[format_], headers=headers)

    @api.post("/api/export/{format}", response_class=Response, responses=told, dependencies=JSON)
    async def export(format: Format, options: models.ExportOptions) -> Response:
        """The plan as a file."""
        return await file(format, options)

    @api.get("/api/export/{format}", response_class=Response, responses=told)
    async def export_link(
        format: Format,
        scene: Annotated[str, Query(description="The body of the same request by POST, as JSON.")],
    ) -> Response:
        """The same for a link."""
        try:
            options = models.ExportOptions.model_validate_json(scene)
        except ValidationError as error:
            found = [one | {"loc": ("query", "scene", *one["loc"])} for one in error.errors(include_url=False)]
            raise RequestValidationError(found) from error
        return await file(format, options)


def _page(api: FastAPI) -> None:
    @api.api_route("/", methods=["GET", "HEAD"], include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(STATIC / "index.html")

    api.mount("/static", StaticFiles(directory=STATIC))
