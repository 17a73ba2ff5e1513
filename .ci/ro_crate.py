"""Validates a folder as RO-Crate 1.2 with roc-validator, whose answers need no network: the JSON-LD
context, which every crate names by its address, is read from a file instead (it is the one of the npm
package ro-crate).

Usage: ro_crate.py CONTEXT.json CRATE
"""

import io
import sys
import urllib.request
import urllib.response

import requests
from requests.adapters import BaseAdapter

ADDRESS = "https://w3id.org/ro/crate/1.2/context"
TYPE = {"Content-Type": "application/ld+json"}


def main():
    file, crate = sys.argv[1:]
    with open(file, "rb") as context:
        answer = context.read()

    class Handler(urllib.request.BaseHandler):
        def https_open(self, request):
            if request.full_url != ADDRESS:
                return None
            return urllib.response.addinfourl(io.BytesIO(answer), TYPE, request.full_url, 200)

    class Adapter(BaseAdapter):
        def send(self, request, **_):
            response = requests.Response()
            response.status_code, response.url, response.request = 200, request.url, request
            response.raw = io.BytesIO(answer)
            response.headers.update(TYPE)
            return response

        def close(self):
            pass

    usual = requests.Session.get_adapter
    requests.Session.get_adapter = lambda self, url: (
        Adapter() if url == ADDRESS else usual(self, url)
    )
    opener = urllib.request.build_opener(Handler)
    urllib.request.install_opener(opener)

    from rocrate_validator import models, services

    settings = services.ValidationSettings(
        rocrate_uri=crate,
        profile_identifier="ro-crate-1.2",
        requirement_severity=models.Severity.RECOMMENDED,
        no_cache=True,
    )
    result = services.validate(settings)
    # What is only recommended is mostly about persons: identifiers, affiliations, addresses.
    wishes = 0
    for issue in result.get_issues():
        if issue.severity == models.Severity.REQUIRED:
            print(f"{issue.violatingEntity}: {issue.message}")
        else:
            wishes += 1
    failed = result.has_issues(models.Severity.REQUIRED)
    verdict = "is no valid" if failed else "is a valid"
    print(f"ro-crate-metadata.json {verdict} RO-Crate 1.2 ({wishes} recommendations not followed)")
    sys.exit(1 if failed else 0)


main()
