"""Write the ledger."""

from experiments.claims.ledger import Numbers, ledger
from experiments.claims.measure import measure
from experiments.claims.rules import VERDICTS
from experiments.store import RESULTS, write_csv


def main() -> None:
    table = ledger(Numbers(measure))
    write_csv(RESULTS / "claims.csv", table)
    counts = ", ".join(f"{(table.verdict == verdict).sum()} {verdict}" for verdict in VERDICTS)
    print(f"claims: {len(table)} claims ({counts}) -> results/claims.csv")


if __name__ == "__main__":
    main()
