"""Write the ledger; where a verdict is no longer borne out, write nothing and say which."""

from experiments.claims.ledger import CONDITION, FAILS, HOLDS, Numbers, ledger
from experiments.claims.measure import measure
from experiments.store import RESULTS, write_csv


def main() -> None:
    table = ledger(Numbers(measure))
    write_csv(RESULTS / "claims.csv", table)
    counts = ", ".join(f"{(table.verdict == verdict).sum()} {verdict}" for verdict in (HOLDS, CONDITION, FAILS))
    print(f"claims: {len(table)} claims ({counts}) -> results/claims.csv")


if __name__ == "__main__":
    main()
