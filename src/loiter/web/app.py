"""The service assembled: endpoints, errors, limits and headers around the library's answers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fastapi import Depends, FastAPI, HTTPException, Request
from fastapi.responses import FileResponse
from fastapi.staticfiles import StaticFiles
from starlette.types import ASGIApp

from loiter.version import __version__
from loiter.web import models, plans, problems
from loiter.web.headers import Headers
from loiter.web.workers import Workers

STATIC = Path(__file__).with_name("static")


def create_app(cors: str | None = None) -> ASGIApp:
    """The service as an ASGI application; `cors` is the one other origin whose pages may ask it."""
    api = FastAPI(title="loiter", version=__version__, docs_url=None, redoc_url=None)
    problems.install(api)
    _routes(api, Workers())
    return Headers(api)


def _routes(api: FastAPI, workers: Workers) -> None:
    json = [Depends(only_json)]

    @api.post("/api/plan", response_model=models.Plan, response_model_exclude_unset=True, dependencies=json)
    async def plan(scene: models.Scene) -> Any:
        return await workers.run(plans.plan, scene.asked())

    @api.post("/api/candidates", response_model=models.Candidates, response_model_exclude_unset=True, dependencies=json)
    async def candidates(scene: models.Scene) -> Any:
        return await workers.run(plans.every, scene.asked())

    @api.get("/healthz", response_model=models.Health)
    async def health() -> Any:
        return {"status": "ok", "version": __version__}

    @api.api_route("/", methods=["GET", "HEAD"], include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(STATIC / "index.html")

    api.mount("/static", StaticFiles(directory=STATIC, check_dir=False))


async def only_json(request: Request) -> None:
    """Refuse a body that does not say it is JSON."""
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/json":
        raise HTTPException(415, "the body must be of the type application/json")
